// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/mesh.h>

#include <cstdint>
#include <span>

namespace asperity::io::detail {

/// Gives a mesh the normals that the smoothing groups of its faces mean: at a vertex the mean, by
/// area, of the facets that share a group with this one; a facet in no group is flat there. Where
/// they differ the vertex is doubled. `groups`: 32 bits a triangle. At a vertex with more than 64
/// different sets of groups facets of the same set alone are joined, so that time stays in
/// proportion to the triangles.
void apply_smoothing_groups(TriangleMesh& mesh, std::span<const std::uint32_t> groups);

}  // namespace asperity::io::detail
