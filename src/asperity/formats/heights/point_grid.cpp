// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/point_grid.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

constexpr double kOnGrid = 0.01;  // of a step

struct Axis {
    double first = 0, step = 0;
    std::uint64_t count = 0;
};

// Coordinates written with few digits scatter about their places: those closer than a thousandth
// of the mean distance are one place.
std::optional<Axis> axis_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const double range = values.back() - values.front();
    if (!(range > 0) || !std::isfinite(range)) return std::nullopt;
    double step = range;
    const double least = range / (10.0 * kMaxSurfaceSide);
    for (std::size_t k = 1; k < values.size(); ++k) {
        const double gap = values[k] - values[k - 1];
        if (gap > least) step = std::min(step, gap);
    }
    const double cells = std::round(range / step);
    if (cells < 1 || cells >= kMaxSurfaceSide) return std::nullopt;
    Axis axis{values.front(), range / cells, static_cast<std::uint64_t>(cells) + 1};
    for (const double v : values) {
        const double place = (v - axis.first) / axis.step;
        if (std::abs(place - std::round(place)) > kOnGrid) return std::nullopt;
    }
    return axis;
}

std::size_t place_of(const PointGrid& grid, double x, double y) {
    const auto i = static_cast<std::uint64_t>(std::round((x - grid.x0) / grid.dx));
    const auto j = static_cast<std::uint64_t>(std::round((y - grid.y0) / grid.dy));
    return static_cast<std::size_t>(j * grid.nx + i);
}

}  // namespace

std::optional<PointGrid> grid_of(const PointList& points) {
    // A point without a place lies on no grid
    for (const auto* axis : {&points.x, &points.y})
        for (const double place : *axis)
            if (!std::isfinite(place)) return std::nullopt;
    if (points.x.size() < 4) return std::nullopt;
    const auto x = axis_of(points.x);
    const auto y = axis_of(points.y);
    if (!x || !y) return std::nullopt;
    const PointGrid grid{x->count, y->count, x->first, y->first, x->step, y->step};
    const std::uint64_t places = grid.nx * grid.ny;
    if (places > 2 * points.x.size() || places < points.x.size()) return std::nullopt;
    std::vector<bool> taken(static_cast<std::size_t>(places));
    for (std::size_t k = 0; k < points.x.size(); ++k) {
        const std::size_t place = place_of(grid, points.x[k], points.y[k]);
        if (taken[place]) return std::nullopt;
        taken[place] = true;
    }
    return grid;
}

Topography on_grid(const PointList& points, const PointGrid& grid, const HeightsSource& source) {
    Topography t = empty_topography(grid.nx, grid.ny, source.path());
    std::vector<std::uint8_t> missing(t.heights.size(), 1);
    for (std::size_t k = 0; k < points.x.size(); ++k) {
        if (!std::isfinite(points.z[k])) continue;
        const std::size_t place = place_of(grid, points.x[k], points.y[k]);
        t.heights[place] = points.z[k];
        missing[place] = 0;
    }
    if (std::count(missing.begin(), missing.end(), 1) > 0) t.missing = std::move(missing);
    t.dx = grid.dx;
    t.dy = grid.dy;
    return t;
}

}  // namespace asperity::io
