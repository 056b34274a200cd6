// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/wide.h>
#include <asperity/tracing/wide_launch.h>

namespace asperity {

/// Rhombi a path walks between two looks around.
inline constexpr int kRhombiPerRound = 4;

/// What a walk has hit, to be told in full later: its line is known beside the vertex `beside`.
struct RawHits {
    std::size_t count = 0;
    PerPath<std::int32_t> a, step_x, step_y, beside, ray;
    PerPath<float> in_second, w, z;
};

/// The work of a wave between two facets.
struct PathWaveWork {
    Walkers walkers;
    RawHits raw;
    TriangleHits hits;
    Leavers leavers;
    LaunchHits launched;
    PerPath<float> start_height;
};

// The kernels, for the instruction set of this processor; each is told where it is written.

/// wide_launch-inl.h
void launch_side_by_side(const LaunchPlace& place, LaunchLine& line, int i, int j, int count,
                         int first, LaunchHits& hits);
void part_answered(const WideGrid& grid, const LaunchLine& line, FacetAnswers answers,
                   LaunchHits& launched, AnsweredRays& answered);
void identify_launched(const LaunchHits& launched, const LaunchLine& line, TriangleHits& hits);
void launch_straight_down(const WideGrid& grid, float u, float v, int i, int j, int count,
                          int first, FacetAnswers answers, FacetPoints& points,
                          AnsweredRays& answered);
/// wide_leave-inl.h
void part_free(const WideGrid& grid, FacetPoints& points, Directions& directions, Escapes& escapes);
void set_out(const WideGrid& grid, const FacetPoints& points, const Directions& directions,
             const PerPath<float>* start_height, Walkers& walkers);
/// wide_walk-inl.h: until no path is under way or all have gone `most_rounds` rounds.
void walk(const WideGrid& grid, bool from_above, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers);
void release(const Leavers& leavers, const Directions& directions, bool with_places,
             Escapes& escapes);
/// wide_land-inl.h
void identify(const WideGrid& grid, const RawHits& raw, const Directions& directions,
              TriangleHits& hits);
void land(const WideGrid& grid, const TriangleHits& hits, FacetPoints& points);

}  // namespace asperity
