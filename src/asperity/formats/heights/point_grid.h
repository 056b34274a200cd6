// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/heights_source.h>

#include <optional>
#include <vector>

namespace asperity::io {

/// Points x y z in any order and unit.
struct PointList {
    std::vector<double> x, y, z;  ///< z: NaN where missing
};

/// A regular grid that points lie on.
struct PointGrid {
    std::uint64_t nx = 0, ny = 0;
    double x0 = 0, y0 = 0, dx = 0, dy = 0;
};

/// The grid, if the points lie on one: equal steps along x and along y within 1 % of a step, no
/// place taken twice, at least half of the places taken. Cost: n log n.
std::optional<PointGrid> grid_of(const PointList& points);

/// Heights on the grid, in the points' unit; places without a point are missing. y grows upwards:
/// y grows with the row, so the smallest becomes the top one.
Topography on_grid(const PointList& points, const PointGrid& grid, const HeightsSource& source);

}  // namespace asperity::io
