// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/heightfield.h>

#include <asperity/core/error.h>
#include <fmt/format.h>

namespace asperity {

Slope facet_slope(const Heightfield& s, int i, int j, Triangle triangle) {
    const double h00 = static_cast<double>(s.at(i, j)), h10 = static_cast<double>(s.at(i + 1, j));
    const double h01 = static_cast<double>(s.at(i, j + 1)),
                 h11 = static_cast<double>(s.at(i + 1, j + 1));
    const bool lower = triangle == Triangle::Lower;
    // The triangle has one edge along x and one along y; the slope is read off those two.
    const bool edge_x_below = lower;
    const bool edge_y_left = (s.diagonal == Diagonal::Anti) == lower;
    return {(edge_x_below ? h10 - h00 : h11 - h01) / s.dx,
            (edge_y_left ? h01 - h00 : h11 - h10) / s.dy};
}

void validate(const Heightfield& s, const std::string& where) {
    const auto fail = [&](std::string why) {
        throw Error(ErrorCode::InvalidInput, std::move(why), where);
    };
    if (s.nx < 2 || s.ny < 2)
        fail(fmt::format("a surface needs 2 x 2 samples, not {} x {}", s.nx, s.ny));
    if (s.nx > kMaxSurfaceSide || s.ny > kMaxSurfaceSide)
        fail(
            fmt::format("{} x {} samples are more than {} on a side", s.nx, s.ny, kMaxSurfaceSide));
    if (s.heights.size() != static_cast<std::size_t>(s.nx) * static_cast<std::size_t>(s.ny))
        fail(fmt::format("{} heights for {} x {} samples", s.heights.size(), s.nx, s.ny));
    const auto usable = [](double d) { return d >= kLeastSpacing && d <= kMostSpacing; };
    if (!usable(s.dx) || !usable(s.dy))
        fail(fmt::format("cell size {} x {} must be {} to {}", s.dx, s.dy, kLeastSpacing,
                         kMostSpacing));
    for (std::size_t k = 0; k < s.heights.size(); ++k) {
        if (std::isfinite(s.heights[k])) continue;
        const auto nx = static_cast<std::size_t>(s.nx);
        fail(fmt::format("height at row {}, column {} is not a finite number", k / nx, k % nx));
    }
}

}  // namespace asperity
