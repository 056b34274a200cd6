// SPDX-License-Identifier: Apache-2.0
//
// From a facet, or from above, onto the way: docs/performance.md, "The walk".

#if defined(ASPERITY_WIDE_LEAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LEAVE_INL_H
#undef ASPERITY_WIDE_LEAVE_INL_H
#else
#define ASPERITY_WIDE_LEAVE_INL_H
#endif

#include <asperity/tracing/ground-inl.h>
#include <asperity/tracing/wide_kernels.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// The cell a facet lies in.
HWY_INLINE Ints cell_of(Ints corner, Floats side) {
    const Ints upper = hn::BroadcastSignBit(hn::BitCast(kInt, side));
    return minus(corner, hn::And(all(pack_vertex(1, 1)), upper));
}

/// Distance of A from the line, so that A lies left of it and B, w_ab further right, right of it.
HWY_INLINE Floats clamp_between(Floats w, Floats w_ab) {
    return hn::Min(hn::Max(w, hn::Zero(kFloat)), hn::Mul(w_ab, all(-0.9999999f)));
}

HWY_INLINE Floats height_at(Floats height, Floats rise_u, Floats rise_v, Floats u, Floats v) {
    return hn::Add(height, hn::Add(hn::Mul(rise_u, u), hn::Mul(rise_v, v)));
}

/// Parts the paths that are free for certain from those that have to be followed: `points` and
/// `directions` keep the latter, side by side; `escapes` gets the others.
template <class GroundT>
void part_free_on(const GroundT& ground, FacetPoints& points, Directions& directions,
                  Escapes& escapes) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Mask valid = first_lanes(k, points.count);
        const Ints corner = load(points.corner, k);
        const Floats side = load(points.side, k), u = load(points.u, k), v = load(points.v, k);
        const Floats height = load(points.height, k), rise_u = load(points.rise_u, k),
                     rise_v = load(points.rise_v, k);
        const Floats x = load(directions.x, k), y = load(directions.y, k),
                     z = load(directions.z, k), level = load(directions.level, k);
        const Ints path = load(directions.path, k);

        const Ints sector = sector_of(x, y);
        const Ints cell = only(valid, ground.wrap(cell_of(corner, side)));
        Floats slope = ground.steepest;
        if (ground.horizon_pays) slope = hn::Min(ground.horizon(cell, sector), slope);
        const Floats here = height_at(height, rise_u, rise_v, u, v);
        const Mask on_top = hn::And(hn::Ge(z, hn::Zero(kFloat)), hn::Ge(here, ground.max_height));
        const Mask free = hn::And(valid, hn::Or(on_top, hn::Gt(z, hn::Mul(slope, level))));

        const Packer pack_free(free);
        pack_free(x, escapes.x, escapes.count);
        pack_free(y, escapes.y, escapes.count);
        pack_free(z, escapes.z, escapes.count);
        pack_free(path, escapes.path, escapes.count);
        if (!ground.periodic) {
            const Floats at_x = hn::Add(hn::ConvertTo(kFloat, x_of(corner)), hn::Mul(side, u));
            const Floats at_y = hn::Add(hn::ConvertTo(kFloat, y_of(corner)), hn::Mul(side, v));
            pack_free(at_x, escapes.at_x, escapes.count);
            pack_free(at_y, escapes.at_y, escapes.count);
            pack_free(here, escapes.at_z, escapes.count);
        }
        escapes.count += pack_free.count;

        const Packer pack(hn::AndNot(free, valid));
        pack(corner, points.corner, kept);
        pack(side, points.side, kept);
        pack(u, points.u, kept);
        pack(v, points.v, kept);
        pack(height, points.height, kept);
        pack(rise_u, points.rise_u, kept);
        pack(rise_v, points.rise_v, kept);
        pack(x, directions.x, kept);
        pack(y, directions.y, kept);
        pack(z, directions.z, kept);
        pack(level, directions.level, kept);
        pack(sector, directions.sector, kept);
        pack(path, directions.path, kept);
        kept += pack.count;
    }
    points.count = kept;
}
void PartFree(const WideGrid& grid, FacetPoints& points, Directions& directions, Escapes& escapes) {
    on_ground(grid, [&](const auto& ground)
                        HWY_ATTR { part_free_on(ground, points, directions, escapes); });
}

/// The two steps from a rhombus to the next: as vertices, across the line and in height.
///
/// With du >= 0 the edges a path crosses every second time are the diagonals (dv >= 0), the x lines
/// (-du <= dv < 0) or the y lines (dv < -du). Two of them and what lies between are a rhombus; the
/// next edge of the kind lies one of two steps ahead, step_x or step_y.
struct Steps {
    Mask by_diagonals, by_rows;
    Ints step_x, step_y;
    Floats w_x, w_y, z_x, z_y;
};
HWY_INLINE Steps steps_of(const Line& line) {
    const Ints v10 = all(pack_vertex(1, 0)), v01 = all(pack_vertex(0, 1)),
               v1m = all(pack_vertex(1, -1)), v0m = all(pack_vertex(0, -1));
    const Floats du = line.du, dv = line.dv, k_x = line.k_x, k_y = line.k_y;
    const Floats sum = hn::Add(du, dv), k_diff = hn::Sub(k_x, k_y), zero = hn::Zero(kFloat);
    Steps s;
    const Mask diagonals = s.by_diagonals = hn::Ge(dv, zero);
    const Mask rows = s.by_rows = hn::AndNot(diagonals, hn::Lt(sum, zero));
    s.step_x = select(diagonals, v10, select(rows, v0m, v1m));
    s.step_y = select(diagonals, v01, select(rows, v1m, v10));
    s.w_x = hn::Neg(select(diagonals, dv, select(rows, du, sum)));
    s.w_y = select(diagonals, du, select(rows, hn::Neg(sum), hn::Neg(dv)));
    s.z_x = select(diagonals, k_x, select(rows, hn::Neg(k_y), k_diff));
    s.z_y = select(diagonals, k_y, select(rows, k_diff, k_x));
    return s;
}

/// Vertex A of the first rhombus, left of the path; B = A + step_x - step_y lies right of it. In
/// the cell of the facet, as a vertex and in numbers; `lower`: the facet is the lower one.
struct FirstVertex {
    Ints in_cell;
    Floats u, v;
};
HWY_INLINE FirstVertex first_vertex(const Steps& s, Mask lower) {
    const Floats one = all(1.0f);
    const Ints v10 = all(pack_vertex(1, 0)), v01 = all(pack_vertex(0, 1)),
               v11 = all(pack_vertex(1, 1));
    return {
        select(lower, select(s.by_rows, v10, v01), select(s.by_diagonals, v01, v11)),
        select(lower, hn::IfThenElseZero(s.by_rows, one), hn::IfThenZeroElse(s.by_diagonals, one)),
        hn::IfThenZeroElse(hn::And(lower, s.by_rows), one)};
}

/// Sets every path onto its strip of rhombi. Paths start on their facets, or over them at the
/// heights `start_height`. The picture is turned by half a turn where du < 0.
template <class GroundT>
void set_out_on(const GroundT& ground, const FacetPoints& points, const Directions& directions,
                const PerPath<float>* start_height, Walkers& walkers) {
    const Floats zero = hn::Zero(kFloat), one = all(1.0f);
    const Ints v11 = all(pack_vertex(1, 1)), nothing = hn::Zero(kInt);
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Floats side = load(points.side, k);
        const Floats h_o = load(points.height, k);
        const Floats rise_u = load(points.rise_u, k), rise_v = load(points.rise_v, k);
        const Floats u_o = load(points.u, k), v_o = load(points.v, k);
        const Floats x = load(directions.x, k), y = load(directions.y, k),
                     z = load(directions.z, k);
        const Floats here =
            start_height ? load(*start_height, k) : height_at(h_o, rise_u, rise_v, u_o, v_o);

        // Turn the picture so that du >= 0
        const Line given = line_of(ground, x, y, z);
        const Mask turned = hn::Lt(given.du, zero);
        const Floats turn = select(turned, all(-1.0f), one);
        const Line line{hn::Mul(turn, given.du), hn::Mul(turn, given.dv), hn::Mul(turn, given.k_x),
                        hn::Mul(turn, given.k_y)};
        const Mask lower = hn::Gt(hn::Mul(turn, side), zero);
        const Floats u = select(lower, u_o, hn::Sub(one, u_o));
        const Floats v = select(lower, v_o, hn::Sub(one, v_o));

        // Where A lies beside the path, and how high the surface is at A and B
        const Steps s = steps_of(line);
        const FirstVertex a = first_vertex(s, lower);
        const Floats a_u = hn::Sub(a.u, u), a_v = hn::Sub(a.v, v);
        const Floats w = hn::Sub(hn::Mul(line.du, a_v), hn::Mul(line.dv, a_u));
        const Floats z_a = hn::Add(here, hn::Add(hn::Mul(line.k_x, a_u), hn::Mul(line.k_y, a_v)));
        const Floats h_x = hn::Add(h_o, rise_u), h_y = hn::Add(h_o, rise_v);
        const Floats h_ahead = select(s.by_rows, h_x, h_y),
                     h_back = select(s.by_diagonals, h_x, h_o);
        const Ints cell = cell_of(load(points.corner, k), side);
        const Mask second = hn::Xor(lower, hn::Or(s.by_diagonals, s.by_rows));

        store(plus(cell, select(turned, minus(v11, a.in_cell), a.in_cell)), walkers.a, k);
        store(select(turned, minus(nothing, s.step_x), s.step_x), walkers.step_x, k);
        store(select(turned, minus(nothing, s.step_y), s.step_y), walkers.step_y, k);
        store(clamp_between(w, hn::Sub(s.w_x, s.w_y)), walkers.w, k);
        store(s.w_x, walkers.w_x, k);
        store(s.w_y, walkers.w_y, k);
        store(z_a, walkers.z, k);
        store(s.z_x, walkers.z_x, k);
        store(s.z_y, walkers.z_y, k);
        store(hn::Sub(select(lower, h_ahead, h_back), z_a), walkers.g_a, k);
        store(hn::Sub(select(lower, h_back, h_ahead), hn::Add(z_a, hn::Sub(s.z_x, s.z_y))),
              walkers.g_b, k);
        store(z, walkers.climb, k);
        store(load(directions.level, k), walkers.level, k);
        store(hn::IfThenElseZero(second, all(-0.0f)), walkers.spared, k);
        store(load(directions.sector, k), walkers.sector, k);
        store(hn::Iota(kInt, static_cast<std::int32_t>(k)), walkers.ray, k);
    }
    walkers.count = points.count;
}
void SetOut(const WideGrid& grid, const FacetPoints& points, const Directions& directions,
            const PerPath<float>* start_height, Walkers& walkers) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        set_out_on(ground, points, directions, start_height, walkers);
    });
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
