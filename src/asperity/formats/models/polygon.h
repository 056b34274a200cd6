// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io::detail {

/// Cuts a polygon into corners.size() - 2 triangles, turned as it is, by clipping its ears; right
/// for every polygon that lies in a plane and does not cross itself, convex or not. Of others some
/// triangles overlap. `corners` are indices into `positions`, at least 3. The time grows with the
/// corners times those that turn inwards, up to a limit: false when that was reached, from where on
/// triangles may overlap.
bool cut_polygon(std::span<const std::uint32_t> corners, const std::vector<Vec3>& positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// What to say when cut_polygon gave up `polygons` times.
std::string remark_on_rough_polygons(std::uint64_t polygons);

}  // namespace asperity::io::detail
