// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/normal_distribution.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace asperity {

namespace {

/// Numbers of facets per cell; grows to its size with the first row.
struct CellCounts {
    std::vector<std::uint64_t> counts;

    CellCounts& operator+=(const CellCounts& other) {
        if (counts.empty()) counts.resize(other.counts.size(), 0);
        for (std::size_t c = 0; c < other.counts.size(); ++c) counts[c] += other.counts[c];
        return *this;
    }
};

int check_bins(int bins, const char* where) {
    if (bins < 1 || bins > 4096)
        throw Error(ErrorCode::Usage, fmt::format("{} is not in 1 .. 4096", bins), where);
    return bins;
}

}  // namespace

double NormalDistribution::projected_solid_angle(int t) const {
    const double step = kPi / 2 / theta_bins;
    const double s1 = std::sin(t * step), s2 = std::sin((t + 1) * step);
    return (s2 * s2 - s1 * s1) / 2 * (2 * kPi / phi_bins);
}

NormalDistribution normal_distribution(const Heightfield& surface, int theta_bins, int phi_bins,
                                       int threads) {
    NormalDistribution result{
        check_bins(theta_bins, "theta bins"), check_bins(phi_bins, "phi bins"), {}};
    const auto columns = static_cast<std::size_t>(phi_bins);
    const auto add_row = [&](CellCounts& part, int j) {
        if (part.counts.empty()) part.counts.resize(static_cast<std::size_t>(theta_bins) * columns);
        visit_facets(surface, j, [&](int, Triangle, Slope s) {
            // The normal leans against the slope
            const double theta = std::atan(std::hypot(s.x, s.y));
            const double phi = azimuth({0.0 - s.x, 0.0 - s.y, 0.0});
            const int t =
                std::min(static_cast<int>(theta / (kPi / 2) * theta_bins), theta_bins - 1);
            const int p = std::min(static_cast<int>(phi / (2 * kPi) * phi_bins), phi_bins - 1);
            ++part.counts[static_cast<std::size_t>(t) * columns + static_cast<std::size_t>(p)];
        });
    };
    const auto cells = sum_rows<CellCounts>(surface.cells_y(), threads, add_row,
                                            rows_per_histogram(surface.cells_y()));
    // All facets have the same projected area: their share of it, per projected solid angle
    const double facets = 2.0 * static_cast<double>(surface.cell_count());
    for (int t = 0; t < theta_bins; ++t)
        for (std::size_t p = 0; p < columns; ++p) {
            const auto count = cells.counts[static_cast<std::size_t>(t) * columns + p];
            result.density.push_back(static_cast<double>(count) /
                                     (facets * result.projected_solid_angle(t)));
        }
    return result;
}

double projected_area(const Heightfield& surface, Vec3 w, int threads) {
    // A facet of unit projected area has the area vector (-slope_x, -slope_y, 1)
    const auto add_row = [&](double& part, int j) {
        visit_facets(surface, j, [&](int, Triangle, Slope s) {
            part += std::max(0.0, w.z - w.x * s.x - w.y * s.y);
        });
    };
    return sum_rows<double>(surface.cells_y(), threads, add_row) /
           (2.0 * static_cast<double>(surface.cell_count()));
}

}  // namespace asperity
