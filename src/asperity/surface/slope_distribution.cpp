// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/slope_distribution.h>

#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>
#include <asperity/surface/length_histogram.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity {

namespace {

/// Counts over a square of slopes; grows to its size with the first slope added.
struct SquareCounts {
    std::vector<std::uint64_t> counts;
    std::uint64_t outside = 0;

    SquareCounts& operator+=(const SquareCounts& other) {
        if (counts.empty()) counts.resize(other.counts.size(), 0);
        for (std::size_t b = 0; b < other.counts.size(); ++b) counts[b] += other.counts[b];
        outside += other.outside;
        return *this;
    }
};

}  // namespace

double SlopeLaw::stretched_length(Slope s) const {
    const double x = s.x / alpha_x, y = s.y / alpha_y;
    return std::sqrt(x * x + y * y);
}

double SlopeLaw::cumulative(double r) const {
    if (family == SlopeFamily::Beckmann) return -std::expm1(-r * r);
    return std::isinf(r) ? 1.0 : r * r / (1 + r * r);
}

double slope_distribution_distance(const Heightfield& surface, const SlopeLaw& law, int threads) {
    using Histogram = LengthHistogram<12>;
    const auto add_row = [&](Histogram& part, int j) {
        visit_facets(surface, j,
                     [&](int, Triangle, Slope s) { part.add(law.stretched_length(s)); });
    };
    const LengthRanks<12> ranks(sum_rows<Histogram>(surface.cells_y(), threads, add_row,
                                                    rows_per_histogram(surface.cells_y())));
    // A slope cut to max_slope along x or y has at least this stretched length
    const double uncut = law.max_slope / std::max(law.alpha_x, law.alpha_y);
    double distance = 0;
    for (int b = 1; b < Histogram::kBins; ++b) {
        const double r = Histogram::lower_end(b);
        if (r > uncut) break;
        const double share =
            static_cast<double>(ranks.below(b)) / static_cast<double>(ranks.total());
        distance = std::max(distance, std::abs(share - law.cumulative(r)));
    }
    return distance;
}

SlopeDistribution slope_distribution(const Heightfield& surface, double limit, int bins,
                                     int threads) {
    if (!(limit > 0) || !std::isfinite(limit))
        throw Error(ErrorCode::Usage, fmt::format("{} is not a positive slope", limit), "limit");
    if (bins < 1 || bins > 4096)
        throw Error(ErrorCode::Usage, fmt::format("{} is not in 1 .. 4096", bins), "bins");
    const auto size = static_cast<std::size_t>(bins);
    const double per_slope = bins / (2 * limit);
    const auto add_row = [&](SquareCounts& part, int j) {
        if (part.counts.empty()) part.counts.resize(size * size, 0);
        visit_facets(surface, j, [&](int, Triangle, Slope s) {
            const double x = (s.x + limit) * per_slope, y = (s.y + limit) * per_slope;
            if (x >= 0 && x < bins && y >= 0 && y < bins) {
                ++part.counts[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)];
            } else {
                ++part.outside;
            }
        });
    };
    const auto counts = sum_rows<SquareCounts>(surface.cells_y(), threads, add_row,
                                               rows_per_histogram(surface.cells_y()));
    const double facets = 2.0 * static_cast<double>(surface.cell_count());
    SlopeDistribution result{limit, bins, {}, static_cast<double>(counts.outside) / facets};
    for (const std::uint64_t count : counts.counts)
        result.density.push_back(static_cast<double>(count) * per_slope * per_slope / facets);
    return result;
}

}  // namespace asperity
