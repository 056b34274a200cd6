// SPDX-License-Identifier: Apache-2.0
//
// Compiles the kernels once for each instruction set and chooses at run time.
#include <asperity/tracing/engines/wide/wide_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <asperity/tracing/engines/wide/wide_kernels.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <asperity/tracing/engines/wide/gathers_pay-inl.h>
#include <asperity/tracing/engines/wide/wide_land-inl.h>
#include <asperity/tracing/engines/wide/wide_launch-inl.h>
#include <asperity/tracing/engines/wide/wide_leave-inl.h>
#include <asperity/tracing/engines/wide/wide_walk-inl.h>

#if HWY_ONCE
namespace asperity {

HWY_EXPORT(GathersPay);
HWY_EXPORT(LaunchInLines);
HWY_EXPORT(LaunchStraightDown);
HWY_EXPORT(PartFree);
HWY_EXPORT(Walk);
HWY_EXPORT(Release);
HWY_EXPORT(Land);
HWY_EXPORT(LandParallel);

bool gathers_pay() {
    return HWY_DYNAMIC_DISPATCH(GathersPay)();
}
bool launch_in_lines(const WideGrid& grid, const PaddedHeights& heights, LaunchLine& line,
                     LaunchStripe& stripe, const CountedFacets& known, std::size_t room,
                     LaunchHits& hits, std::size_t& counted) {
    return HWY_DYNAMIC_DISPATCH(LaunchInLines)(grid, heights, line, stripe, known, room, hits,
                                               counted);
}
void launch_straight_down(const WideGrid& grid, float u, float v, const LaunchedRow& row,
                          const CountedFacets& known, FacetPoints& points, std::size_t& counted) {
    HWY_DYNAMIC_DISPATCH(LaunchStraightDown)(grid, u, v, row, known, points, counted);
}
void part_free(const WideGrid& grid, FacetPoints& points, Directions& directions,
               Escapes& escapes) {
    HWY_DYNAMIC_DISPATCH(PartFree)(grid, points, directions, escapes);
}
void walk(const WideGrid& grid, const FacetPoints& points, Directions& directions,
          const PerPath<float>* start_height, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers) {
    HWY_DYNAMIC_DISPATCH(Walk)
    (grid, points, directions, start_height, most_rounds, walkers, hits, leavers);
}
void release(const WideGrid& grid, const Leavers& leavers, const Directions& directions,
             Escapes& escapes) {
    HWY_DYNAMIC_DISPATCH(Release)(grid, leavers, directions, escapes);
}
void land(const WideGrid& grid, const RawHits& hits, const Directions& directions,
          FacetPoints& points) {
    HWY_DYNAMIC_DISPATCH(Land)(grid, hits, directions, points);
}
void land_parallel(const WideGrid& grid, const LaunchLine& line, const LaunchHits& hits,
                   const Vec3& direction, FacetPoints& points) {
    HWY_DYNAMIC_DISPATCH(LandParallel)(grid, line, hits, direction, points);
}

}  // namespace asperity
#endif
