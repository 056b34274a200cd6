// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/slope_fit.h>

#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>
#include <asperity/surface/length_histogram.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity {

namespace {

using Histogram = LengthHistogram<8>;

template <typename Size>
Histogram histogram_of(const Heightfield& surface, int threads, const Size& size) {
    const auto add_row = [&](Histogram& part, int j) {
        visit_facets(surface, j, [&](int, Triangle, Slope s) { part.add(size(s)); });
    };
    return sum_rows<Histogram>(surface.cells_y(), threads, add_row,
                               rows_per_histogram(surface.cells_y()));
}

double median_of(const Histogram& histogram) {
    const LengthRanks<8> ranks(histogram);
    const double half = 0.5 * static_cast<double>(ranks.total());
    for (int b = 0; b < Histogram::kBins; ++b) {
        const auto low = static_cast<double>(ranks.below(b)),
                   high = static_cast<double>(ranks.below(b + 1));
        if (high < half || b == 0) {
            if (b == 0 && high >= half) return 0;
            continue;
        }
        const double t = (half - low) / (high - low);
        return Histogram::lower_end(b) +
               t * (Histogram::lower_end(b + 1) - Histogram::lower_end(b));
    }
    return 0;
}

/// Shares of the slopes below lengths.
struct Step {
    double length = 0, share = 0;
};

double misfit(const std::vector<Step>& steps, SlopeFamily family, double alpha) {
    const SlopeLaw law{.family = family};
    double distance = 0;
    for (const Step& step : steps)
        distance = std::max(distance, std::abs(step.share - law.cumulative(step.length / alpha)));
    return distance;
}

}  // namespace

std::optional<SlopeFit> fit_slopes(const Heightfield& surface, SlopeFamily family, int threads) {
    const double x =
        median_of(histogram_of(surface, threads, [](Slope s) { return std::abs(s.x); }));
    const double y =
        median_of(histogram_of(surface, threads, [](Slope s) { return std::abs(s.y); }));
    if (x == 0 || y == 0) return std::nullopt;
    const double ratio = y / x;
    const LengthRanks<8> ranks(
        histogram_of(surface, threads, [&](Slope s) { return std::hypot(s.x, s.y / ratio); }));
    std::vector<Step> steps;
    for (int b = 1; b < Histogram::kBins; ++b)
        if (ranks.below(b) != ranks.below(b - 1) || ranks.below(b + 1) != ranks.below(b))
            steps.push_back({Histogram::lower_end(b), static_cast<double>(ranks.below(b)) /
                                                          static_cast<double>(ranks.total())});
    // Golden section over the logarithm: the misfit falls to one lowest place
    constexpr double kGolden = 0.6180339887498949;
    double low = std::log(x / 8), high = std::log(x * 8);
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = misfit(steps, family, std::exp(a)), at_b = misfit(steps, family, std::exp(b));
    while (high - low > 1e-5) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            a = high - kGolden * (high - low);
            at_a = misfit(steps, family, std::exp(a));
        } else {
            low = a, a = b, at_a = at_b;
            b = low + kGolden * (high - low);
            at_b = misfit(steps, family, std::exp(b));
        }
    }
    const double alpha = std::exp(0.5 * (low + high));
    return SlopeFit{alpha, alpha * ratio, misfit(steps, family, alpha)};
}

}  // namespace asperity
