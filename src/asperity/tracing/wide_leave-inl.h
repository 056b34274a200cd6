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
        pack(path, directions.path, kept);
        kept += pack.count;
    }
    points.count = kept;
}
void PartFree(const WideGrid& grid, FacetPoints& points, Directions& directions, Escapes& escapes) {
    on_ground(grid, [&](const auto& ground)
                        HWY_ATTR { part_free_on(ground, points, directions, escapes); });
}

/// How a path sees the cells it crosses, by the quadrant of its direction: it comes from the near
/// corner, with a corner to its left and one to its right, and goes to the far one. In quadrants 1
/// and 3 the diagonal runs across, from left to right; in 2 and 4 it runs along, from near to far.
struct View {
    Mask flip_x, flip_y;  ///< the path runs towards smaller x, y
    Mask along;

    HWY_INLINE View(Mask to_small_x, Mask to_small_y)
        : flip_x(to_small_x), flip_y(to_small_y), along(hn::Xor(to_small_x, to_small_y)) {}

    /// The left corner as seen from (0, 0).
    HWY_INLINE Ints left_corner() const {
        return hn::Or(only(flip_y, all(pack_vertex(1, 0))),
                      hn::IfThenZeroElse(hn::RebindMask(kInt, flip_x), all(pack_vertex(0, 1))));
    }
    /// From cell to cell, over the edge on the right or on the left.
    HWY_INLINE Ints step_r() const { return select(along, step_y(), step_x()); }
    HWY_INLINE Ints step_l() const { return select(along, step_x(), step_y()); }

  private:
    HWY_INLINE Ints step_x() const {
        return select(flip_x, all(pack_vertex(-1, 0)), all(pack_vertex(1, 0)));
    }
    HWY_INLINE Ints step_y() const {
        return select(flip_y, all(pack_vertex(0, -1)), all(pack_vertex(0, 1)));
    }
};

/// Distance of the left corner from the line of a path, so that it lies left of it and the right
/// corner, `across` further, right of it.
HWY_INLINE Floats clamp_between(Floats w, Floats across) {
    return hn::Min(hn::Max(w, hn::Zero(kFloat)), hn::Mul(across, all(0.9999999f)));
}

/// Paths of a vector as they are kept in Walkers.
struct Setting {
    Ints cell;
    Floats w, w_l, w_r, z, z_l, z_r;
    Floats climb, level;
    Floats passed;  ///< only of paths that set out
    Ints sector, ray;
};

/// Sets paths on their way. They start on their facets, or over them at the heights `start_height`.
template <class GroundT>
HWY_INLINE Setting set_out(const GroundT& ground, const FacetPoints& points, Directions& directions,
                           const PerPath<float>* start_height, std::size_t k) {
    const Floats zero = hn::Zero(kFloat), one = all(1.0f);
    const Floats side = load(points.side, k), u = load(points.u, k), v = load(points.v, k);
    const Floats x = load(directions.x, k), y = load(directions.y, k), z = load(directions.z, k);
    hn::StoreInterleaved4(x, y, z, hn::BitCast(kFloat, load(directions.path, k)), kFloat,
                          &directions.headings.values[k].x);
    const Floats here = start_height ? load(*start_height, k)
                                     : height_at(load(points.height, k), load(points.rise_u, k),
                                                 load(points.rise_v, k), u, v);

    // Cells and height per length of path, and how far from the near corner it starts; straight up
    // is taken for a hair off
    const Floats level = load(directions.level, k);
    const Line line = line_of(ground, select(hn::Gt(level, zero), x, all(1e-12f)), y, z);
    const View view(hn::Lt(x, zero), hn::Lt(y, zero));
    const Mask upper = negative(side);
    const Floats p = select(hn::Xor(upper, view.flip_x), hn::Sub(one, u), u);
    const Floats q = select(hn::Xor(upper, view.flip_y), hn::Sub(one, v), v);
    const Floats du = hn::Abs(line.du), dv = hn::Abs(line.dv);
    const Floats w_l = select(view.along, dv, du), w_r = hn::Neg(select(view.along, du, dv));
    const Floats z_l = hn::Mul(hn::Neg(w_r), line.rate), z_r = hn::Mul(w_l, line.rate);
    const Floats along_r = select(view.along, q, p), along_l = select(view.along, p, q);
    const auto at_left = [&](Floats l, Floats r) HWY_ATTR {
        return hn::Sub(hn::Mul(hn::Sub(one, along_l), l), hn::Mul(along_r, r));
    };
    const Floats w = clamp_between(at_left(w_l, w_r), hn::Sub(w_l, w_r));

    // On the second of the two facets? Only one is met if the diagonal is not crossed
    const Mask on_left = hn::Xor(upper, view.flip_x);  // or, where it runs across, on the far one
    const Mask far_right = negative(hn::Add(w, w_r));
    const Mask second = hn::Xor(on_left, hn::AndNot(far_right, view.along));

    return {cell_of(load(points.corner, k), side),
            w,
            w_l,
            w_r,
            hn::Add(here, at_left(z_l, z_r)),
            z_l,
            z_r,
            z,
            level,
            hn::IfThenElseZero(second, all(-0.0f)),
            sector_of(x, y),
            hn::Iota(kInt, static_cast<std::int32_t>(k))};
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
