// SPDX-License-Identifier: Apache-2.0
//
// Where in a triangle a path meets it.

#if defined(ASPERITY_WIDE_LAND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LAND_INL_H
#undef ASPERITY_WIDE_LAND_INL_H
#else
#define ASPERITY_WIDE_LAND_INL_H
#endif

#include <asperity/tracing/wide_walk-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// The two corners of a facet beside O, as steps from it.
HWY_INLINE Ints corner_u(Floats side) {
    return select(negative(side), all(pack_vertex(-1, 0)), all(pack_vertex(1, 0)));
}
HWY_INLINE Ints corner_v(Floats side) {
    return select(negative(side), all(pack_vertex(0, -1)), all(pack_vertex(0, 1)));
}

/// Tells which triangles were hit, and where the lines of the paths are beside their corners.
template <class GroundT>
void identify_on(const GroundT& ground, const RawHits& raw, const Directions& directions,
                 TriangleHits& hits) {
    for (std::size_t k = 0; k < raw.count; k += kLanes) {
        const Mask valid = first_lanes(k, raw.count);
        // The triangle A, B, A + step_x or A - step_y; O is the corner with the right angle
        const Ints a = load(raw.a, k);
        const Ints step_x = load(raw.step_x, k), step_y = load(raw.step_y, k);
        const Ints b = plus(a, minus(step_x, step_y));
        const Ints c = select(negative(load(raw.in_second, k)), plus(a, step_x), minus(a, step_y));
        const Ints cell = smaller(a, smaller(b, c));
        const Ints sum = minus(plus(minus(a, cell), minus(b, cell)), minus(cell, c));
        const Ints upper = hn::And(minus(sum, all(pack_vertex(1, 1))), all(pack_vertex(1, 1)));
        const Ints corner = plus(cell, upper);
        const Mask is_lower = hn::RebindMask(kFloat, hn::Eq(upper, hn::Zero(kInt)));

        const Ints ray = only(valid, load(raw.ray, k));
        const Line line = line_of(ground, gather(directions.x, ray), gather(directions.y, ray),
                                  gather(directions.z, ray));
        const Ints away = minus(corner, load(raw.beside, k));
        const Floats dx = hn::ConvertTo(kFloat, x_of(away)), dy = hn::ConvertTo(kFloat, y_of(away));
        const auto along = [&](Floats per_x, Floats per_y)
                               HWY_ATTR { return hn::Add(hn::Mul(per_x, dx), hn::Mul(per_y, dy)); };
        store(corner, hits.corner, k);
        store(select(is_lower, all(1.0f), all(-1.0f)), hits.side, k);
        store(hn::Add(load(raw.w, k), along(hn::Neg(line.dv), line.du)), hits.w, k);
        store(hn::Add(load(raw.z, k), along(line.k_x, line.k_y)), hits.z, k);
        store(line.du, hits.du, k);
        store(line.dv, hits.dv, k);
        store(line.k_x, hits.k_x, k);
        store(line.k_y, hits.k_y, k);
        store(ray, hits.ray, k);
    }
    hits.count = raw.count;
}
void Identify(const WideGrid& grid, const RawHits& raw, const Directions& directions,
              TriangleHits& hits) {
    on_ground(grid,
              [&](const auto& ground) HWY_ATTR { identify_on(ground, raw, directions, hits); });
}

/// Finds the points where the paths meet their triangles: the surface above the path, g, and the
/// distance from its line, w, both vanish there, so its barycentric coordinates are the cross
/// product of both at the three corners.
template <class GroundT>
void land_on(const GroundT& ground, const TriangleHits& hits, FacetPoints& points) {
    const Floats zero = hn::Zero(kFloat), one = all(1.0f);
    for (std::size_t k = 0; k < hits.count; k += kLanes) {
        const Mask valid = first_lanes(k, hits.count);
        const Ints corner = only(valid, load(hits.corner, k));
        const Floats side = load(hits.side, k);
        const Line line{load(hits.du, k), load(hits.dv, k), load(hits.k_x, k), load(hits.k_y, k)};
        const Floats height = ground.height(corner);
        const Floats rise_u = hn::Sub(ground.height(plus(corner, corner_u(side))), height);
        const Floats rise_v = hn::Sub(ground.height(plus(corner, corner_v(side))), height);

        const Floats w_o = load(hits.w, k);
        const Floats w_u = hn::Sub(w_o, hn::Mul(side, line.dv));
        const Floats w_v = hn::Add(w_o, hn::Mul(side, line.du));
        const Floats g_o = hn::Sub(height, load(hits.z, k));
        const Floats g_u = hn::Add(g_o, hn::Sub(rise_u, hn::Mul(side, line.k_x)));
        const Floats g_v = hn::Add(g_o, hn::Sub(rise_v, hn::Mul(side, line.k_y)));
        const auto cross = [](Floats w1, Floats g1, Floats w2, Floats g2)
                               HWY_ATTR { return hn::Sub(hn::Mul(w1, g2), hn::Mul(w2, g1)); };
        const Floats b_o = cross(w_u, g_u, w_v, g_v), b_u = cross(w_v, g_v, w_o, g_o),
                     b_v = cross(w_o, g_o, w_u, g_u);
        const Floats share = hn::Div(one, hn::Add(b_o, hn::Add(b_u, b_v)));
        const Floats u = hn::Min(hn::Max(hn::Mul(b_u, share), zero), one);
        const Floats v = hn::Min(hn::Max(hn::Mul(b_v, share), zero), hn::Sub(one, u));

        store(ground.periodic ? ground.wrap(corner) : corner, points.corner, k);
        store(side, points.side, k);
        store(u, points.u, k);
        store(v, points.v, k);
        store(height, points.height, k);
        store(rise_u, points.rise_u, k);
        store(rise_v, points.rise_v, k);
        store(load(hits.ray, k), points.ray, k);
    }
    points.count = hits.count;
}
void Land(const WideGrid& grid, const TriangleHits& hits, FacetPoints& points) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR { land_on(ground, hits, points); });
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
