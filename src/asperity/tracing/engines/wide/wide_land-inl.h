// SPDX-License-Identifier: Apache-2.0
//
// Where in a triangle a path meets it.

#if defined(ASPERITY_WIDE_LAND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LAND_INL_H
#undef ASPERITY_WIDE_LAND_INL_H
#else
#define ASPERITY_WIDE_LAND_INL_H
#endif

#include <asperity/tracing/engines/wide/wide_walk-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// A triangle, and the line of the path that has fallen into it: its distance `w` from the corner,
/// and the path's height `z` beside that.
struct Fallen {
    Ints cell;
    Mask upper;
    Floats w, z;
    Line line;
};

/// Finds the points where paths meet their triangles: the surface above the path, g, and the
/// distance from its line, w, both vanish there, so its barycentric coordinates are the cross
/// product of both at the three corners.
template <class GroundT>
HWY_INLINE void land_at(const GroundT& ground, const Fallen& at, Mask valid, FacetPoints& points,
                        std::size_t k) {
    const Floats zero = hn::Zero(kFloat), one = all(1.0f);
    const CellHeights h = ground.corners(only(valid, at.cell));
    const Floats height = select(at.upper, h.h11, h.h00);
    const Floats rise_u = hn::Sub(select(at.upper, h.h01, h.h10), height);
    const Floats rise_v = hn::Sub(select(at.upper, h.h10, h.h01), height);
    const Floats side = select(at.upper, all(-1.0f), one);

    const Floats w_o = at.w;
    const Floats w_u = hn::Sub(w_o, hn::Mul(side, at.line.dv));
    const Floats w_v = hn::Add(w_o, hn::Mul(side, at.line.du));
    const Floats g_o = hn::Sub(height, at.z);
    const Floats g_u = hn::Add(g_o, hn::Sub(rise_u, hn::Mul(side, at.line.k_x)));
    const Floats g_v = hn::Add(g_o, hn::Sub(rise_v, hn::Mul(side, at.line.k_y)));
    const auto cross = [](Floats w1, Floats g1, Floats w2, Floats g2)
                           HWY_ATTR { return hn::Sub(hn::Mul(w1, g2), hn::Mul(w2, g1)); };
    const Floats b_o = cross(w_u, g_u, w_v, g_v), b_u = cross(w_v, g_v, w_o, g_o),
                 b_v = cross(w_o, g_o, w_u, g_u);
    const Floats share = hn::Div(one, hn::Add(b_o, hn::Add(b_u, b_v)));
    const Floats u = hn::Min(hn::Max(hn::Mul(b_u, share), zero), one);
    const Floats v = hn::Min(hn::Max(hn::Mul(b_v, share), zero), hn::Sub(one, u));

    const Ints corner = plus(at.cell, only(at.upper, all(pack_vertex(1, 1))));
    store(ground.periodic ? ground.wrap(corner) : corner, points.corner, k);
    store(side, points.side, k);
    store(u, points.u, k);
    store(v, points.v, k);
    store(height, points.height, k);
    store(rise_u, points.rise_u, k);
    store(rise_v, points.rise_v, k);
}

/// Tells which of a cell's two facets was hit.
template <class GroundT>
HWY_INLINE Fallen identify(const GroundT& ground, const RawHits& hits, const Fields& heading,
                           std::size_t k) {
    const Floats zero = hn::Zero(kFloat);
    Fallen f;
    f.cell = load(hits.cell, k);
    f.line = line_of(ground, heading.a, heading.b, heading.c);
    const View view(hn::Lt(heading.a, zero), hn::Lt(heading.b, zero));
    const auto beside = [&](Floats at, Floats per_x, Floats per_y, Ints away) HWY_ATTR {
        return hn::Add(at, hn::Add(hn::Mul(per_x, hn::ConvertTo(kFloat, x_of(away))),
                                   hn::Mul(per_y, hn::ConvertTo(kFloat, y_of(away)))));
    };

    // Where the diagonal runs along, the path came to the left of it last if the far corner is on
    // the right, and first if the near one is
    const Ints way = minus(f.cell, load(hits.from_cell, k));
    const Mask in_first = negative(load(hits.in_first, k));
    const Floats w_left = beside(load(hits.w, k), hn::Neg(f.line.dv), f.line.du, way);
    const Floats w_l = hn::Abs(select(view.along, f.line.dv, f.line.du)),
                 w_r = hn::Neg(hn::Abs(select(view.along, f.line.du, f.line.dv)));
    const Floats w_end = select(in_first, hn::Sub(w_left, w_l), hn::Add(w_left, w_r));
    const Mask on_left =
        hn::Or(hn::And(view.along, negative(w_end)), hn::Not(hn::Or(view.along, in_first)));
    f.upper = hn::Xor(on_left, view.flip_x);

    const Ints to_corner =
        minus(plus(way, only(f.upper, all(pack_vertex(1, 1)))), view.left_corner());
    f.w = beside(load(hits.w, k), hn::Neg(f.line.dv), f.line.du, to_corner);
    f.z = beside(load(hits.z, k), f.line.k_x, f.line.k_y, to_corner);
    return f;
}

void Land(const WideGrid& grid, const RawHits& hits, const Directions& directions,
          FacetPoints& points) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        constexpr Gather kGather = std::decay_t<decltype(ground)>::kGather;
        for (std::size_t k = 0; k < hits.count; k += kLanes) {
            const Mask valid = first_lanes(k, hits.count);
            const Fields heading =
                gather_fields<kGather>(directions.headings.values, only(valid, load(hits.ray, k)));
            land_at(ground, identify(ground, hits, heading, k), valid, points, k);
            store(heading.a, points.x, k);
            store(heading.b, points.y, k);
            store(heading.c, points.z, k);
            store(hn::BitCast(kInt, heading.d), points.path, k);
        }
    });
    points.count = hits.count;
}

void LandParallel(const WideGrid& grid, const LaunchLine& line, const LaunchHits& hits,
                  const Vec3& direction, FacetPoints& points) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        const Line light =
            line_of(ground, all(static_cast<float>(direction.x)),
                    all(static_cast<float>(direction.y)), all(static_cast<float>(direction.z)));
        constexpr Gather kGather = std::decay_t<decltype(ground)>::kGather;
        for (std::size_t k = 0; k < hits.count; k += kLanes) {
            const Mask valid = first_lanes(k, hits.count);
            const Fields triangle =
                gather_fields<kGather>(line.triangles(), only(valid, load(hits.triangle, k)));
            const Ints corner = plus(load(hits.cell, k), hn::BitCast(kInt, triangle.a));
            const Floats side = triangle.b;
            const Fallen fallen{cell_of(corner, side), negative(side), triangle.c,
                                hn::Sub(load(hits.z, k), triangle.d), light};
            land_at(ground, fallen, valid, points, k);
        }
    });
    points.count = hits.count;
}

/// Rays straight down meet the facet below them; nothing to fly. Those that are to be followed are
/// appended to `points`.
void LaunchStraightDown(const WideGrid& grid, float u, float v, const LaunchedRow& row,
                        const CountedFacets& known, FacetPoints& points, std::size_t& counted) {
    const Ground<true, Gather::OneByOne> ground(grid);
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
        const Ints lane = counting_from(k);
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
        points.count += pack.count;
    }
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
