// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity::io::detail {

/// Cuts a polygon into corners.size() - 2 triangles, turned as it is, by clipping its ears; right
/// for every polygon that lies in a plane and does not cross itself, convex or not. Of others some
/// triangles overlap. `corners` are indices into `positions`, at least 3. Polygons of more than
/// 1000 corners are cut as a fan, which is right for convex ones.
void cut_polygon(std::span<const std::uint32_t> corners, const std::vector<Vec3f>& positions,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace asperity::io::detail
