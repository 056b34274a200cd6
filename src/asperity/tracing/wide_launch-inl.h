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
/// `at` points to the first ray's first vertex. Backwards, so that the first one wins.
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

/// Whether all rays of a group fly above everything in a round that begins at the sample (x, y).
HWY_INLINE bool flies_above(const RowTops& tops, const LaunchLine::Round& round, int x, int y) {
    static_assert(kLaunchGroup - 1 + LaunchLine::kReach <=
                  RowTops::kPiece * (RowTops::kPieces - 1));
    static_assert(LaunchLine::kReach + 1 <= RowTops::kRowsMore && RowTops::kPieces == 8);
    const hn::CappedTag<float, 8> pieces;
    const std::size_t lanes = hn::Lanes(pieces);
    const float* from = tops.from(x, y);
    auto top = hn::LoadU(pieces, from);
    for (int row = 0; row < round.rows; ++row)
        for (std::size_t k = 0; k < RowTops::kPieces; k += lanes)
            top = hn::Max(top, hn::LoadU(pieces, from + row * tops.pitch() + k));
    return hn::AllTrue(pieces, hn::Le(top, hn::Set(pieces, round.lowest_z)));
}

/// A group of kLaunchGroup rays from cell (i, j) on, as far as they are `open`; hits are appended.
HWY_INLINE void launch_group(const LaunchPlace& place, LaunchLine& line, int i, int j, int first,
                             Mask (&open)[kVectors], LaunchHits& hits) {
    static_assert(kLaunchGroup + LaunchLine::kReach <= PaddedHeights::kMargin);
    const PaddedHeights& heights = *place.heights;
    bool flying = true;
    for (std::size_t r = 0; flying; ++r) {
        const LaunchLine::Round& round = line.round(r);
        const int x = wrapped(i + round.lowest_x, heights.cells_x());
        const int y = wrapped(j + round.lowest_y, heights.cells_y());
        if (flies_above(*place.tops, round, x, y)) continue;

        // Where the first ray's cell would be if its way led here without leaving the tile
        const int start_x = x - round.lowest_x, start_y = y - round.lowest_y;
        const float* at = heights.origin() +
                          static_cast<std::ptrdiff_t>(start_y + round.first_y) * heights.pitch() +
                          (start_x + round.first_x);
        Floats first_edges[kVectors];
        find_first_edges(round, at, first_edges);
        flying = false;
        for (int n = 0; n < kVectors; ++n) {
            const Ints edge = hn::BitCast(kInt, first_edges[n]);
            const Mask below = hn::RebindMask(kFloat, hn::Lt(edge, all(LaunchLine::kEdges)));
            const Mask hit = hn::And(open[n], below);
            if (!hn::AllFalse(kFloat, hit)) {
                const Ints lane = hn::Iota(kInt, n * static_cast<int>(kLanes));
                const Ints cell_x = hn::Add(all(start_x - place.grid->middle_x), lane);
                const Ints cell_y = all(pack_vertex(0, start_y - place.grid->middle_y));
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

/// Leaves those of `count` rays open that have to fly, and counts the others; true if there are
/// any.
HWY_INLINE bool find_open(const CountedFacets& known, int i, int j, int count,
                          Mask (&open)[kVectors], std::size_t& counted) {
    bool any = false;
    for (int n = 0; n < kVectors; ++n) {
        const std::size_t lane = static_cast<std::size_t>(n) * kLanes;
        open[n] = first_lanes(lane, static_cast<std::size_t>(count));
        if (known.cells) {
            const hn::Rebind<std::uint8_t, IntTag> bytes;
            const std::uint8_t* at =
                known.cells + static_cast<std::ptrdiff_t>(j) * known.pitch + i + lane;
            const Ints byte = hn::PromoteTo(kInt, hn::LoadU(bytes, at));
            const Mask sure = hn::And(
                open[n], hn::RebindMask(kFloat, hn::Eq(hn::And(byte, all(CountedFacets::kOpen)),
                                                       hn::Zero(kInt))));
            counted += hn::CountTrue(kFloat, sure);
            open[n] = hn::AndNot(sure, open[n]);
        }
        any = any || !hn::AllFalse(kFloat, open[n]);
    }
    return any;
}

void LaunchSideBySide(const LaunchPlace& place, LaunchLine& line, const LaunchedRow& row,
                      const CountedFacets& known, LaunchHits& hits, std::size_t& counted) {
    for (int k = 0; k < row.count; k += kLaunchGroup) {
        const int i = row.i + k;
        Mask open[kVectors];
        if (find_open(known, i, row.j, std::min(row.count - k, kLaunchGroup), open, counted))
            launch_group(place, line, i, row.j, row.first + k, open, hits);
    }
}

/// Lanes whose facets are counted ones.
HWY_INLINE Mask is_counted(const WideGrid& grid, const Ground<true>& ground, Mask valid,
                           const CountedFacets& known, Ints corner, Floats side) {
    const Ints cell = ground.wrap(cell_of(corner, side));
    const Ints first = all(grid.middle_y * known.pitch + grid.middle_x);
    const Ints byte =
        gather_bytes(known.cells, only(valid, hn::Add(index_of(cell, known.pitch), first)));
    const Ints bit = select(negative(side), all(CountedFacets::kUpper), all(CountedFacets::kLower));
    return hn::And(valid, hn::RebindMask(kFloat, hn::Ne(hn::And(byte, bit), hn::Zero(kInt))));
}

/// Looks up the triangles that were hit, and appends those that are to be followed to `hits`.
void SortLaunched(const WideGrid& grid, const LaunchLine& line, const LaunchHits& launched,
                  const CountedFacets& known, ParallelHits& hits, std::size_t& counted) {
    const Ground<true> ground(grid);
    const LaunchLine::Triangle* triangles = line.triangles();
    for (std::size_t k = 0; k < launched.count; k += kLanes) {
        const Mask valid = first_lanes(k, launched.count);
        const Fields triangle = gather_fields(triangles, only(valid, load(launched.triangle, k)));
        const Ints corner = plus(load(launched.cell, k), hn::BitCast(kInt, triangle.a));
        const Floats side = triangle.b;
        Mask open = valid;
        if (known.cells) {
            const Mask sure = is_counted(grid, ground, valid, known, corner, side);
            counted += hn::CountTrue(kFloat, sure);
            open = hn::AndNot(sure, valid);
        }
        const Packer pack(open);
        pack(corner, hits.corner, hits.count);
        pack(side, hits.side, hits.count);
        pack(triangle.c, hits.w, hits.count);
        pack(triangle.d, hits.z, hits.count);
        pack(load(launched.ray, k), hits.ray, hits.count);
        hits.count += pack.count;
    }
}

/// Rays straight down meet the facet below them; nothing to fly. Those that are to be followed are
/// appended to `points`.
void LaunchStraightDown(const WideGrid& grid, float u, float v, const LaunchedRow& row,
                        const CountedFacets& known, FacetPoints& points, std::size_t& counted) {
    const Ground<true> ground(grid);
    const bool upper = u + v >= 1;
    const int corner = upper ? 1 : 0, step = upper ? -1 : 1;
    const float* at = grid.middle +
                      static_cast<std::ptrdiff_t>(row.j + corner - grid.middle_y) * grid.pitch +
                      (row.i + corner - grid.middle_x);
    const std::uint8_t* bytes =
        known.cells ? known.cells + static_cast<std::ptrdiff_t>(row.j) * known.pitch + row.i
                    : nullptr;
    const std::uint8_t bit = upper ? CountedFacets::kUpper : CountedFacets::kLower;
    const hn::Rebind<std::uint8_t, IntTag> byte;
    for (int k = 0; k < row.count; k += static_cast<int>(kLanes)) {
        Mask open = first_lanes(static_cast<std::size_t>(k), static_cast<std::size_t>(row.count));
        if (bytes) {
            const Ints facets = hn::PromoteTo(kInt, hn::LoadU(byte, bytes + k));
            const Mask sure =
                hn::And(open, hn::RebindMask(kFloat, hn::TestBit(facets, all(std::int32_t{bit}))));
            counted += hn::CountTrue(kFloat, sure);
            open = hn::AndNot(sure, open);
            if (hn::AllFalse(kFloat, open)) continue;
        }
        const Ints lane = hn::Iota(kInt, k);
        const Ints x = hn::Add(lane, all(row.i + corner - grid.middle_x));
        const Ints vertex = ground.wrap(
            hn::Or(hn::And(x, all(0xffff)), all(pack_vertex(0, row.j + corner - grid.middle_y))));
        const Floats height = hn::LoadU(kFloat, at + k);
        const Packer pack(open);
        pack(vertex, points.corner, points.count);
        pack(all(upper ? -1.0f : 1.0f), points.side, points.count);
        pack(all(upper ? 1 - u : u), points.u, points.count);
        pack(all(upper ? 1 - v : v), points.v, points.count);
        pack(height, points.height, points.count);
        pack(hn::Sub(hn::LoadU(kFloat, at + k + step), height), points.rise_u, points.count);
        pack(hn::Sub(hn::LoadU(kFloat, at + k + step * std::ptrdiff_t{grid.pitch}), height),
             points.rise_v, points.count);
        pack(hn::Add(lane, all(row.first)), points.path, points.count);
        points.count += pack.count;
    }
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
