// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engines/wide/wide.h>
#include <asperity/tracing/engines/wide/wide_launch.h>

namespace asperity {

/// Cells a path walks between two looks around.
inline constexpr int kCellsPerRound = 4;

/// What a walk has hit, to be told in full later: a cell, by its first facet or its second, and the
/// line of the path beside the left corner of another cell.
struct RawHits {
    std::size_t count = 0;
    PerPath<std::int32_t> cell, from_cell, ray;
    PerPath<float> in_first, w, z;
};

/// The work of a wave between two facets.
struct PathWaveWork {
    Walkers walkers;
    RawHits raw;
    Leavers leavers;
    LaunchHits launched;
    PerPath<float> start_height;
};

/// Whether this processor brings values together faster with its own instructions for it than one
/// by one. Measured, in some 20 us: it differs between makes of the same instruction set by 3 to 1
/// either way.
bool gathers_pay();

// The kernels, for the instruction set of this processor; each is told where it is written.

/// wide_launch-inl.h; `counted` grows by the rays onto counted facets.
bool launch_in_lines(const WideGrid& grid, const PaddedHeights& heights, LaunchLine& line,
                     LaunchStripe& stripe, const CountedFacets& known, std::size_t room,
                     LaunchHits& hits, std::size_t& counted);
void launch_straight_down(const WideGrid& grid, float u, float v, const LaunchedRow& row,
                          const CountedFacets& known, FacetPoints& points, std::size_t& counted);
/// wide_leave-inl.h
void part_free(const WideGrid& grid, FacetPoints& points, Directions& directions, Escapes& escapes);
/// wide_walk-inl.h: from the facets, or from above them at the heights `start_height` if that is
/// not null, until no path is under way or all have gone `most_rounds` rounds.
void walk(const WideGrid& grid, const FacetPoints& points, Directions& directions,
          const PerPath<float>* start_height, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers);
void release(const WideGrid& grid, const Leavers& leavers, const Directions& directions,
             Escapes& escapes);
/// wide_land-inl.h
void land(const WideGrid& grid, const RawHits& hits, const Directions& directions,
          FacetPoints& points);
void land_parallel(const WideGrid& grid, const LaunchLine& line, const LaunchHits& hits,
                   const Vec3& direction, FacetPoints& points);

}  // namespace asperity
