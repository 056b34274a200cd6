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

/// Vectors of rays that fly side by side; constants are fetched once for all of them.
constexpr int kVectors = kLaunchGroup / static_cast<int>(kLanes);

/// The number of the first edge of the round at which each ray is below the surface, or kEdges;
/// `at` points to the sample at the first ray's cell. Backwards, so that the first one wins.
HWY_INLINE void find_first_edges(const LaunchLine::Round& round, const float* at,
                                 Floats (&first)[kVectors]) {
    for (Floats& f : first) f = hn::BitCast(kFloat, all(LaunchLine::kEdges));
    for (int n = LaunchLine::kEdges - 1; n >= 0; --n) {
        const LaunchLine::Edge& edge = round.edges[n];
        const Floats w_left = all(edge.w_left), w_right = all(edge.w_right),
                     limit = all(edge.limit), number = hn::BitCast(kFloat, all(n));
        const float* left = at + edge.left;
        const float* right = at + edge.right;
        for (std::size_t k = 0; k < kVectors; ++k) {
            const Floats above =
                hn::Sub(hn::Sub(hn::Mul(hn::LoadU(kFloat, left + k * kLanes), w_right),
                                hn::Mul(hn::LoadU(kFloat, right + k * kLanes), w_left)),
                        limit);
            first[k] = select_by_sign(above, number, first[k]);
        }
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
    const PaddedHeights& heights = *place.heights;
    Mask open[kVectors];  // lanes that have not hit yet
    for (int n = 0; n < kVectors; ++n)
        open[n] =
            first_lanes(static_cast<std::size_t>(n) * kLanes, static_cast<std::size_t>(count));
    bool flying = true;
    for (std::size_t r = 0; flying; ++r) {
        const LaunchLine::Round& round = line.round(r);
        const int x = wrapped(i + round.lowest_x, heights.cells_x());
        const int y = wrapped(j + round.lowest_y, heights.cells_y());
        if (round.lowest_z >= place.tops->top(x, y)) continue;

        const float* at = heights.origin() +
                          static_cast<std::ptrdiff_t>(y - round.lowest_y) * heights.pitch() +
                          (x - round.lowest_x);
        Floats first_edges[kVectors];
        find_first_edges(round, at, first_edges);
        flying = false;
        for (int n = 0; n < kVectors; ++n) {
            const Ints edge = hn::BitCast(kInt, first_edges[n]);
            const Mask below = hn::RebindMask(kFloat, hn::Lt(edge, all(LaunchLine::kEdges)));
            const Mask hit = hn::And(open[n], below);
            if (!hn::AllFalse(kFloat, hit)) {
                const Ints lane = hn::Iota(kInt, n * static_cast<int>(kLanes));
                const Ints cell_x = hn::Add(all(x - round.lowest_x - place.grid->middle_x), lane);
                const Ints cell_y = all((y - round.lowest_y - place.grid->middle_y) * (1 << 16));
                const Packer pack(hit);
                pack(hn::Add(all(static_cast<std::int32_t>(r) * LaunchLine::kEdges), edge),
                     hits.triangle, hits.count);
                pack(hn::Or(hn::And(cell_x, all(0xffff)), cell_y), hits.cell, hits.count);
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

/// The answers for facets, by their corners and sides; -1 in lanes that are not valid.
struct Answers {
    Ints facet, answer;
    Mask known;
};
HWY_INLINE Answers answers_of(const WideGrid& grid, const Ground<true>& ground, Mask valid,
                              FacetAnswers answers, Ints corner, Floats side) {
    const Ints cell = ground.wrap(cell_of(corner, side));
    const Ints plane =
        hn::And(hn::BroadcastSignBit(hn::BitCast(kInt, side)), all(grid.cells_x * grid.cells_y));
    const Ints first = all(grid.middle_y * grid.cells_x + grid.middle_x);
    Answers a;
    a.facet = only(valid, hn::Add(hn::Add(index_of(cell, grid.cells_x), first), plane));
    a.answer = gather(answers, a.facet);
    a.known = hn::AndNot(negative(hn::BitCast(kFloat, a.answer)), valid);
    return a;
}
HWY_INLINE void pack_answered(const Answers& a, Ints ray, AnsweredRays& answered) {
    const Packer pack(a.known);
    pack(a.answer, answered.answer, answered.count);
    pack(a.facet, answered.facet, answered.count);
    pack(ray, answered.ray, answered.count);
    answered.count += pack.count;
}

/// Takes the rays out whose facets have an answer; the others move up.
void PartAnswered(const WideGrid& grid, const LaunchLine& line, FacetAnswers answers,
                  LaunchHits& launched, AnsweredRays& answered) {
    const Ground<true> ground(grid);
    const LaunchLine::Triangle* triangles = line.triangles();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < launched.count; k += kLanes) {
        const Mask valid = first_lanes(k, launched.count);
        const Ints triangle = only(valid, load(launched.triangle, k));
        const Ints start = load(launched.cell, k), ray = load(launched.ray, k);
        const Ints corner = gather_by_lane<std::int32_t>(
            triangle, [=](std::int64_t n) { return triangles[n].corner; });
        const Floats side =
            gather_by_lane<float>(triangle, [=](std::int64_t n) { return triangles[n].side; });
        const Answers a = answers_of(grid, ground, valid, answers, plus(start, corner), side);
        pack_answered(a, ray, answered);

        const Packer pack(hn::AndNot(a.known, valid));
        pack(triangle, launched.triangle, kept);
        pack(start, launched.cell, kept);
        pack(ray, launched.ray, kept);
        kept += pack.count;
    }
    launched.count = kept;
}

/// Looks up the triangles that were hit, and appends them to `hits`.
void IdentifyLaunched(const LaunchHits& launched, const LaunchLine& line, TriangleHits& hits) {
    const LaunchLine::Triangle* triangles = line.triangles();
    const Floats du = all(static_cast<float>(line.du())), dv = all(static_cast<float>(line.dv()));
    const Floats k_x = all(static_cast<float>(line.k_x())),
                 k_y = all(static_cast<float>(line.k_y()));
    for (std::size_t k = 0; k < launched.count; k += kLanes) {
        const Ints at = only(first_lanes(k, launched.count), load(launched.triangle, k));
        const auto append = [&](auto value, auto& to) HWY_ATTR {
            hn::StoreU(value, hn::DFromV<decltype(value)>(), to.values + hits.count + k);
        };
        const auto fetch = [&](auto field) HWY_ATTR {
            using Field = std::remove_cvref_t<decltype(triangles->*field)>;
            return gather_by_lane<Field>(at, [=](std::int64_t n) { return triangles[n].*field; });
        };
        append(plus(load(launched.cell, k), fetch(&LaunchLine::Triangle::corner)), hits.corner);
        append(fetch(&LaunchLine::Triangle::side), hits.side);
        append(fetch(&LaunchLine::Triangle::w), hits.w);
        append(fetch(&LaunchLine::Triangle::z), hits.z);
        append(du, hits.du);
        append(dv, hits.dv);
        append(k_x, hits.k_x);
        append(k_y, hits.k_y);
        append(load(launched.ray, k), hits.ray);
    }
    hits.count += launched.count;
}

/// Rays straight down meet the facet below them; nothing to fly. Appends them to `points`, and
/// those whose facet has an answer to `answered`.
void LaunchStraightDown(const WideGrid& grid, float u, float v, int i, int j, int count, int first,
                        FacetAnswers answers, FacetPoints& points, AnsweredRays& answered) {
    const Ground<true> ground(grid);
    const bool upper = u + v >= 1;
    const Floats side = all(upper ? -1.0f : 1.0f);
    const int corner = upper ? 1 : 0;
    for (int k = 0; k < count; k += static_cast<int>(kLanes)) {
        const Ints lane = hn::Iota(kInt, k), ray = hn::Add(lane, all(first));
        const Ints x = hn::Add(lane, all(i + corner - grid.middle_x));
        const Ints vertex = ground.wrap(
            hn::Or(hn::And(x, all(0xffff)), all(pack_vertex(0, j + corner - grid.middle_y))));
        Mask open = first_lanes(static_cast<std::size_t>(k), static_cast<std::size_t>(count));
        if (answers) {
            const Answers a = answers_of(grid, ground, open, answers, vertex, side);
            pack_answered(a, ray, answered);
            open = hn::AndNot(a.known, open);
            if (hn::AllFalse(kFloat, open)) continue;
        }
        const Floats height = ground.height(vertex);
        const Packer pack(open);
        pack(vertex, points.corner, points.count);
        pack(side, points.side, points.count);
        pack(all(upper ? 1 - u : u), points.u, points.count);
        pack(all(upper ? 1 - v : v), points.v, points.count);
        pack(height, points.height, points.count);
        pack(hn::Sub(ground.height(plus(vertex, corner_u(side))), height), points.rise_u,
             points.count);
        pack(hn::Sub(ground.height(plus(vertex, corner_v(side))), height), points.rise_v,
             points.count);
        pack(ray, points.ray, points.count);
        points.count += pack.count;
    }
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
