// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/detector.h>
#include <asperity/tracing/padded_heights.h>
#include <asperity/tracing/wide.h>

namespace asperity {

/// Mirrors paths at the facets they stand on, in single precision: leaving[k] is the direction of
/// points k, cosine[k] the cosine between it and the facet's normal. With `parallel` all paths come
/// along arriving[0], and path k is ray k.
void reflect_paths(const FacetPoints& points, const Directions& arriving, bool parallel,
                   const PaddedHeights& heights, Directions& leaving, PerPath<float>& cosine);

/// Detector::cell_of for the directions of paths, within some 1e-7 rad of the cells' edges.
/// mirror_x is -1 if the directions are to be mirrored in x, else 1; cos_phi and sin_phi, by path,
/// turn them back about the normal unless they are null.
void find_cells(const Escapes& escapes, const Detector& detector, float mirror_x,
                const PerPath<float>* cos_phi, const PerPath<float>* sin_phi,
                PerPath<std::int32_t>& cells);

}  // namespace asperity
