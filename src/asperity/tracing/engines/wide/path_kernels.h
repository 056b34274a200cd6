// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/detector/detector.h>
#include <asperity/tracing/engines/wide/padded_heights.h>
#include <asperity/tracing/engines/wide/wide.h>
#include <asperity/tracing/engines/wide/wide_grid.h>
#include <asperity/tracing/engines/wide/wide_launch.h>

namespace asperity {

/// Mirrors paths at the facets they stand on, in single precision: leaving[k] is the direction of
/// points k, cosine[k] the cosine between it and the facet's normal. Where `parallel` is not null
/// all paths come along it.
void reflect_paths(const FacetPoints& points, const Vec3* parallel, const PaddedHeights& heights,
                   Directions& leaving, PerPath<float>* cosine);

/// The azimuth of the light, from which that of what leaves is counted: of all paths, or of each
/// path its own where these are not null.
struct Turn {
    float cos_phi = 1, sin_phi = 0;
    const PerPath<float>*cos_phi_of = nullptr, *sin_phi_of = nullptr;
};

/// Detector::cell_of for the directions of paths, within some 1e-7 rad of the cells' edges.
/// mirror_x is -1 if the directions are to be mirrored in x, else 1; then they are turned back
/// about the normal.
void find_cells(const Escapes& escapes, const Detector& detector, float mirror_x, const Turn& turn,
                PerPath<std::int32_t>& cells);

/// What becomes of parallel light on the lower or upper facets of a row of cells, one value each;
/// may be written up to kSlack values beyond the row.
struct FacetRow {
    static constexpr std::size_t kSlack = 16;
    std::int32_t* cells;  ///< of the detector: where the facet sends it
    /// Of a facet that lies in the light as a whole and mirrors it out for certain: what it takes,
    /// a whole number of units of 1 / unit of what falls onto half a cell. Of others: 0.
    float* flux;
    float* cosine;  ///< as of reflect_paths; null: not asked for
};
/// Looks at both facets of the cells of row `j` in parallel light along `d`, in the frame of the
/// tracer. Sets CountedFacets' bits in `known`, which has kSlack bytes more.
void look_at_facets(const WideGrid& grid, const Detector& detector, float mirror_x, Vec3 d,
                    float unit, int j, const FacetRow& lower, const FacetRow& upper,
                    std::uint8_t* known);

}  // namespace asperity
