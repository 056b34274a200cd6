// SPDX-License-Identifier: Apache-2.0
//
// From a facet, or from above, onto the way: docs/performance.md, "The walk".

#if defined(ASPERITY_WIDE_LEAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_LEAVE_INL_H
#undef ASPERITY_WIDE_LEAVE_INL_H
#else
#define ASPERITY_WIDE_LEAVE_INL_H
#endif

#include <asperity/tracing/engines/wide/ground-inl.h>
#include <asperity/tracing/engines/wide/wide_kernels.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// The cell a facet lies in.
HWY_INLINE Ints cell_of(Ints corner, Floats side) {
    const Ints upper = hn::BroadcastSignBit(hn::BitCast(kInt, side));
    return minus(corner, hn::And(all(pack_vertex(1, 1)), upper));
}

HWY_INLINE Floats height_of(const FacetPoints& points, std::size_t k) {
    return hn::Add(load(points.height, k),
                   hn::Add(hn::Mul(load(points.rise_u, k), load(points.u, k)),
                           hn::Mul(load(points.rise_v, k), load(points.v, k))));
}

/// Which paths of a vector are free for certain: above everything, or beyond the horizon.
template <class GroundT>
HWY_INLINE Mask free_ones(const GroundT& ground, const FacetPoints& points,
                          const Directions& directions, Mask valid, std::size_t k) {
    const Floats z = load(directions.z, k);
    Floats slope = ground.steepest;
    if (ground.horizon_pays) {
        const Ints cell = cell_of(load(points.corner, k), load(points.side, k));
        const Ints sector = sector_of(load(directions.x, k), load(directions.y, k));
        slope = hn::Min(ground.horizon(only(valid, ground.wrap(cell)), sector), slope);
    }
    const Mask on_top =
        hn::And(hn::Ge(z, hn::Zero(kFloat)), hn::Ge(height_of(points, k), ground.max_height));
    return hn::And(valid, hn::Or(on_top, hn::Gt(z, hn::Mul(slope, load(directions.level, k)))));
}

/// Appends the paths of a vector that are free, and over finite patches where they are.
template <class GroundT>
HWY_INLINE void pack_free(const GroundT& ground, const FacetPoints& points,
                          const Directions& directions, Mask free, std::size_t k,
                          Escapes& escapes) {
    const Packer pack(free);
    pack(load(directions.x, k), escapes.x, escapes.count);
    pack(load(directions.y, k), escapes.y, escapes.count);
    pack(load(directions.z, k), escapes.z, escapes.count);
    pack(load(directions.path, k), escapes.path, escapes.count);
    if (!ground.periodic) {
        const Ints corner = load(points.corner, k);
        const auto place = [&](Ints of_corner, const PerPath<float>& along) HWY_ATTR {
            return hn::Add(hn::ConvertTo(kFloat, of_corner),
                           hn::Mul(load(points.side, k), load(along, k)));
        };
        pack(place(x_of(corner), points.u), escapes.at_x, escapes.count);
        pack(place(y_of(corner), points.v), escapes.at_y, escapes.count);
        pack(height_of(points, k), escapes.at_z, escapes.count);
    }
    escapes.count += pack.count;
}

/// Parts the paths that are free for certain from those that have to be followed: `points` and
/// `directions` keep the latter, side by side; `escapes` gets the others.
template <class GroundT>
void part_free_on(const GroundT& ground, FacetPoints& points, Directions& directions,
                  Escapes& escapes) {
    // First all looks, then all packing: short loops
    constexpr std::size_t kBytes = (kLanes + 7) / 8;
    std::uint8_t free_bits[kWave / kLanes * kBytes + 8] = {};
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Mask valid = first_lanes(k, points.count);
        hn::StoreMaskBits(kFloat, free_ones(ground, points, directions, valid, k),
                          free_bits + k / kLanes * kBytes);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.count; k += kLanes) {
        const Mask free = hn::LoadMaskBits(kFloat, free_bits + k / kLanes * kBytes);
        pack_free(ground, points, directions, free, k, escapes);
        const Packer pack(hn::AndNot(free, first_lanes(k, points.count)));
        const auto keep = [&](auto& values) HWY_ATTR { pack(load(values, k), values, kept); };
        keep(points.corner);
        keep(points.side);
        keep(points.u);
        keep(points.v);
        keep(points.height);
        keep(points.rise_u);
        keep(points.rise_v);
        keep(directions.x);
        keep(directions.y);
        keep(directions.z);
        keep(directions.level);
        keep(directions.path);
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
    const Floats here = start_height ? load(*start_height, k) : height_of(points, k);

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
            counting_from(static_cast<std::int32_t>(k))};
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
