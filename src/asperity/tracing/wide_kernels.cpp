// SPDX-License-Identifier: Apache-2.0
//
// Compiles the kernels once for each instruction set and chooses at run time.
#include <asperity/tracing/wide_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/tracing/wide_kernels.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <asperity/tracing/wide_land-inl.h>
#include <asperity/tracing/wide_launch-inl.h>
#include <asperity/tracing/wide_leave-inl.h>
#include <asperity/tracing/wide_walk-inl.h>

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(LaunchSideBySide);
HWY_EXPORT(PartAnswered);
HWY_EXPORT(IdentifyLaunched);
HWY_EXPORT(LaunchStraightDown);
HWY_EXPORT(PartFree);
HWY_EXPORT(SetOut);
HWY_EXPORT(Walk);
HWY_EXPORT(Release);
HWY_EXPORT(Identify);
HWY_EXPORT(Land);

void launch_side_by_side(const LaunchPlace& place, LaunchLine& line, int i, int j, int count,
                         int first, LaunchHits& hits) {
    HWY_DYNAMIC_DISPATCH(LaunchSideBySide)(place, line, i, j, count, first, hits);
}
void part_answered(const WideGrid& grid, const LaunchLine& line, FacetAnswers answers,
                   LaunchHits& launched, AnsweredRays& answered) {
    HWY_DYNAMIC_DISPATCH(PartAnswered)(grid, line, answers, launched, answered);
}
void identify_launched(const LaunchHits& launched, const LaunchLine& line, TriangleHits& hits) {
    HWY_DYNAMIC_DISPATCH(IdentifyLaunched)(launched, line, hits);
}
void launch_straight_down(const WideGrid& grid, float u, float v, int i, int j, int count,
                          int first, FacetAnswers answers, FacetPoints& points,
                          AnsweredRays& answered) {
    HWY_DYNAMIC_DISPATCH(LaunchStraightDown)
    (grid, u, v, i, j, count, first, answers, points, answered);
}
void part_free(const WideGrid& grid, FacetPoints& points, Directions& directions,
               Escapes& escapes) {
    HWY_DYNAMIC_DISPATCH(PartFree)(grid, points, directions, escapes);
}
void set_out(const WideGrid& grid, const FacetPoints& points, const Directions& directions,
             const PerPath<float>* start_height, Walkers& walkers) {
    HWY_DYNAMIC_DISPATCH(SetOut)(grid, points, directions, start_height, walkers);
}
void walk(const WideGrid& grid, bool from_above, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers) {
    HWY_DYNAMIC_DISPATCH(Walk)(grid, from_above, most_rounds, walkers, hits, leavers);
}
void release(const Leavers& leavers, const Directions& directions, bool with_places,
             Escapes& escapes) {
    HWY_DYNAMIC_DISPATCH(Release)(leavers, directions, with_places, escapes);
}
void identify(const WideGrid& grid, const RawHits& raw, const Directions& directions,
              TriangleHits& hits) {
    HWY_DYNAMIC_DISPATCH(Identify)(grid, raw, directions, hits);
}
void land(const WideGrid& grid, const TriangleHits& hits, FacetPoints& points) {
    HWY_DYNAMIC_DISPATCH(Land)(grid, hits, points);
}

}  // namespace asperity
#endif
