// SPDX-License-Identifier: Apache-2.0
//
// The first hits of rays launched side by side: no gathers, the way is known (launch_line.h).

#if defined(ASPERITY_WIDE_LAUNCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LAUNCH_INL_H
#undef ASPERITY_WIDE_LAUNCH_INL_H
#else
#define ASPERITY_WIDE_LAUNCH_INL_H
#endif

#include <asperity/tracing/launch_line.h>
#include <asperity/tracing/row_tops.h>
#include <asperity/tracing/wide_land-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// Rays side by side, and how far each has come in a round: the number of edges tested before one
/// was below the surface.
struct Group {
    Floats g_a, g_b;
    Floats hit;  ///< negative once the lane has hit
    Ints edges;  ///< minus the edges tested since the hit, this one included

    HWY_INLINE void test(Floats above) {
        hit = hn::Or(hit, above);
        edges = hn::Add(edges, hn::BroadcastSignBit(hn::BitCast(kInt, hit)));
    }
};

/// One round for the rays that start at heights[...]: `at` points to the first ray's start cell.
HWY_INLINE void fly_round(const LaunchLine::Round& round, const float* at, Group& group) {
    group.edges = hn::Zero(kInt);
    group.g_a = hn::Sub(hn::LoadU(kFloat, at + round.a), all(round.z_a));
    group.g_b = hn::Sub(hn::LoadU(kFloat, at + round.b), all(round.z_b));
    group.test(Strip::at_edge(group.g_a, all(round.w_a), group.g_b, all(round.w_b)));
    for (const LaunchLine::Step& step : round.steps) {
        const Mask right = hn::RebindMask(kFloat, hn::MaskFromVec(all(step.right)));
        const Floats g_c = hn::Sub(hn::LoadU(kFloat, at + step.c), all(step.z_c));
        group.test(Strip::at_edge(select(right, group.g_a, g_c), all(step.side_left),
                                  select(right, g_c, group.g_b), all(step.side_right)));
        const Floats g_fresh = hn::Sub(hn::LoadU(kFloat, at + step.fresh), all(step.z_fresh));
        group.g_a = select(right, g_fresh, g_c);
        group.g_b = select(right, g_c, g_fresh);
        group.test(Strip::at_edge(group.g_a, all(step.w_a), group.g_b, all(step.w_b)));
    }
}

/// Remainder that is never negative; mostly there is nothing to do.
HWY_INLINE int wrapped(int index, int count) {
    if (index >= 0 && index < count) return index;
    const int rest = index % count;
    return rest < 0 ? rest + count : rest;
}

/// A group of kLaunchGroup rays, `count` of them wanted, from cell (i, j) on; hits are appended.
HWY_INLINE void launch_group(const LaunchPlace& place, LaunchLine& line, int i, int j, int first,
                             int count, LaunchHits& hits) {
    constexpr int kVectors = kLaunchGroup / static_cast<int>(kLanes);
    const PaddedHeights& heights = *place.heights;
    Group groups[kVectors];
    Mask open[kVectors];  // lanes that have not hit yet
    for (int n = 0; n < kVectors; ++n) {
        groups[n].hit = hn::Zero(kFloat);
        open[n] =
            first_lanes(static_cast<std::size_t>(n) * kLanes, static_cast<std::size_t>(count));
    }
    bool flying = true;
    for (std::size_t r = 0; flying; ++r) {
        const LaunchLine::Round& round = line.round(r);
        const int x = wrapped(i + round.lowest_x, heights.cells_x());
        const int y = wrapped(j + round.lowest_y, heights.cells_y());
        if (round.lowest_z >= place.tops->top(x, y)) continue;

        const float* at = heights.origin() +
                          static_cast<std::ptrdiff_t>(y - round.lowest_y) * heights.pitch() +
                          (x - round.lowest_x);
        flying = false;
        for (int n = 0; n < kVectors; ++n) {
            Group& group = groups[n];
            fly_round(round, at + n * static_cast<int>(kLanes), group);
            const Mask hit = hn::And(open[n], negative(group.hit));
            if (!hn::AllFalse(kFloat, hit)) {
                // Edges before the first one below the surface: the number of the triangle
                const Ints triangle = hn::Add(all(LaunchLine::kEdges), group.edges);
                const Ints lane = hn::Iota(kInt, n * static_cast<int>(kLanes));
                const int base_x = x - round.lowest_x - place.grid->middle_x;
                const int base_y = y - round.lowest_y - place.grid->middle_y;
                const Packer pack(hit);
                pack(hn::Add(all(static_cast<std::int32_t>(r) * LaunchLine::kEdges), triangle),
                     hits.triangle, hits.count);
                pack(hn::Add(all(base_x), lane), hits.x, hits.count);
                pack(all(base_y), hits.y, hits.count);
                pack(hn::Add(all(first), lane), hits.ray, hits.count);
                hits.count += pack.count;
                open[n] = hn::AndNot(hit, open[n]);
            }
            flying = flying || !hn::AllFalse(kFloat, open[n]);
        }
    }
}

void LaunchSideBySide(const LaunchPlace& place, LaunchLine& line, int i, int j, int count,
                      int first, LaunchHits& hits) {
    for (int k = 0; k < count; k += kLaunchGroup) {
        const int start = i + k < place.grid->cells_x ? i + k : i + k - place.grid->cells_x;
        launch_group(place, line, start, j, first + k, std::min(count - k, kLaunchGroup), hits);
    }
}

/// Rays straight down meet the facet below them; nothing to fly.
void LaunchStraightDown(const WideGrid& grid, float u, float v, int i, int j, int count, int first,
                        FacetPoints& points) {
    const Ground ground(grid);
    const bool upper = u + v >= 1;
    const Floats side = all(upper ? -1.0f : 1.0f);
    const int corner = upper ? 1 : 0;
    for (int k = 0; k < count; k += static_cast<int>(kLanes)) {
        const Ints lane = hn::Iota(kInt, k);
        const Ints x = hn::Add(lane, all(i + corner - grid.middle_x));
        const Ints vertex = ground.wrap(
            hn::Or(hn::And(x, all(0xffff)), all(pack_vertex(0, j + corner - grid.middle_y))));
        const Floats height = ground.height(vertex);
        const auto append = [&](auto value, auto& to) HWY_ATTR {
            hn::StoreU(value, hn::DFromV<decltype(value)>(),
                       to.values + points.count + static_cast<std::size_t>(k));
        };
        append(vertex, points.corner);
        append(side, points.side);
        append(all(upper ? 1 - u : u), points.u);
        append(all(upper ? 1 - v : v), points.v);
        append(height, points.height);
        append(hn::Sub(ground.height(plus(vertex, corner_u(side))), height), points.rise_u);
        append(hn::Sub(ground.height(plus(vertex, corner_v(side))), height), points.rise_v);
        append(hn::Add(lane, all(first)), points.ray);
    }
    points.count += static_cast<std::size_t>(count);
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
