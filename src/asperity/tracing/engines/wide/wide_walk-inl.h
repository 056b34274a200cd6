// SPDX-License-Identifier: Apache-2.0
//
// The walk from facet to facet, the heart of the program. docs/performance.md, "The walk".
//
// A path goes from cell to cell. It sees of each the near and the far corner, one on its left and
// one on its right (View), whose heights come with one load. With w the distance of a corner from
// the path's line, positive on the left, and g the height of the surface over the path there, the
// surface under the path at an edge (L, R) rises above it just when g_L w_R - g_R w_L < 0, as
// w_L >= 0 > w_R. Two edges of a cell are tested, in the order the path crosses them: the diagonal,
// if it is crossed, and the one that leads out, over which the path goes on. No division, no
// epsilon, every edge once.

#if defined(ASPERITY_WIDE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_WALK_INL_H
#undef ASPERITY_WIDE_WALK_INL_H
#else
#define ASPERITY_WIDE_WALK_INL_H
#endif

#include <asperity/tracing/engines/wide/wide_leave-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// Paths in the lanes of a vector, in their cells.
struct Way {
    Ints cell;
    Floats w;                       ///< distance of the left corner from the path's line
    Floats z;                       ///< height of the path beside that corner
    const Floats w_l, w_r, across;  ///< change of w to the left, to the right, from left to right
    const Floats z_l, z_r;
    const View view;
    const Ints step_l, step_r;
    // Of the edge over which the path came in
    Floats above;     ///< clearance times the distance of its two ends
    Mask from_right;  ///< it was the one on the right of the cell before

    HWY_INLINE Way(const Setting& from, Mask valid)
        : cell(only(valid, from.cell)),
          w(from.w),
          z(from.z),
          w_l(from.w_l),
          w_r(from.w_r),
          across(hn::Sub(w_l, w_r)),
          z_l(from.z_l),
          z_r(from.z_r),
          view(has_bit(from.sector, 1), has_bit(from.sector, 2)),
          step_l(view.step_l()),
          step_r(view.step_r()),
          above(hn::Zero(kFloat)),
          from_right(valid) {}

  private:
    HWY_INLINE static Mask has_bit(Ints sector, std::int32_t bit) {
        return hn::RebindMask(kFloat, hn::TestBit(sector, all(bit)));
    }
};

/// One value at each corner of a cell, as the path sees them.
struct Corners {
    Floats near, right, far, left;

    /// Turns the cell by a quarter (along) and by half a turn (flip_y).
    HWY_INLINE Corners(const CellHeights& h, const View& view) {
        const Floats a = select(view.along, h.h10, h.h00), b = select(view.along, h.h11, h.h10),
                     c = select(view.along, h.h01, h.h11), d = select(view.along, h.h00, h.h01);
        near = select(view.flip_y, c, a);
        right = select(view.flip_y, d, b);
        far = select(view.flip_y, a, c);
        left = select(view.flip_y, b, d);
    }
};

/// The first hit of each lane: negative `hit` says there was one, on the first facet of the cell if
/// `in_first` is negative, else on the second.
struct FirstHit {
    Floats hit, in_first;
    Ints cell;

    HWY_INLINE void note(Floats diagonal, Floats way_out, Ints at) {
        in_first = select_by_sign(hit, in_first, diagonal);
        cell = hn::BitCast(kInt,
                           select_by_sign(hit, hn::BitCast(kFloat, cell), hn::BitCast(kFloat, at)));
        hit = hn::Or(hit, hn::Or(diagonal, way_out));
    }
};

/// Crosses a cell. `no_diagonal` and `no_way_out` are -0 where an edge is not to be tested.
template <class GroundT>
HWY_INLINE void cross_cell(const GroundT& ground, Way& way, FirstHit& first, Floats no_diagonal,
                           Floats no_way_out) {
    const auto rises = [](Floats g_l, Floats w_l, Floats g_r, Floats w_r)
                           HWY_ATTR { return hn::Sub(hn::Mul(g_l, w_r), hn::Mul(g_r, w_l)); };
    const Corners h(ground.corners(way.cell), way.view);
    const Floats w_near = hn::Sub(way.w, way.w_l), w_right = hn::Sub(way.w, way.across),
                 w_far = hn::Add(way.w, way.w_r);
    const Floats z_near = hn::Sub(way.z, way.z_l);
    const Floats g_near = hn::Sub(h.near, z_near), g_left = hn::Sub(h.left, way.z),
                 g_right = hn::Sub(h.right, hn::Add(z_near, way.z_r)),
                 g_far = hn::Sub(h.far, hn::Add(way.z, way.z_r));

    // The diagonal: from left to right, or from near to far if these lie on both sides
    const Mask along = way.view.along;
    const Floats w_p = select(along, w_near, way.w), w_q = select(along, w_far, w_right);
    const Floats risen =
        rises(select(along, g_near, g_left), w_p, select(along, g_far, g_right), w_q);
    const Floats diagonal = hn::And(hn::Xor(risen, w_p), hn::Xor(w_p, w_q));

    // Out on the left of the far corner, or on the right
    const Mask on_left = negative(w_far);
    way.above = rises(select(on_left, g_left, g_far), select(on_left, way.w, w_far),
                      select(on_left, g_far, g_right), select(on_left, w_far, w_right));
    first.note(hn::AndNot(no_diagonal, diagonal), hn::AndNot(no_way_out, way.above), way.cell);
    way.cell = plus(way.cell, select(on_left, way.step_l, way.step_r));
    way.w = hn::Add(way.w, select(on_left, way.w_l, way.w_r));
    way.z = hn::Add(way.z, select(on_left, way.z_l, way.z_r));
    way.from_right = hn::Not(on_left);
}

/// What paths carry along beside their place.
struct Bound {
    Floats climb, level;
    Ints sector, ray;
};

/// Appends the lanes that have hit; they began the round in the cell `from`, with `w` and `z`.
HWY_INLINE void pack_hits(Mask hit, const FirstHit& first, Ints from, Floats w, Floats z, Ints ray,
                          RawHits& hits) {
    if (hn::AllFalse(kFloat, hit)) return;
    const Packer pack(hit);
    pack(first.cell, hits.cell, hits.count);
    pack(first.in_first, hits.in_first, hits.count);
    pack(from, hits.from_cell, hits.count);
    pack(w, hits.w, hits.count);
    pack(z, hits.z, hits.count);
    pack(ray, hits.ray, hits.count);
    hits.count += pack.count;
}

/// Where a path has come into its cell, and what it sees from there.
struct Outlook {
    Mask out;          ///< above everything or beyond the horizon
    Floats r, l;       ///< from the near corner towards the right and the left one
    Floats height;     ///< of the path
    Floats clearance;  ///< above the surface
    Floats rise;       ///< the surface ahead rises no more than this per length of path
};

/// Looks around, and brings the cell back to the first tile.
template <class GroundT>
HWY_INLINE Outlook look_around(const GroundT& ground, Way& way, const Bound& bound, Mask valid,
                               Mask alive) {
    const Floats zero = hn::Zero(kFloat);
    Outlook look;
    const Floats per_w = hn::Div(all(1.0f), select(way.from_right, way.w_l, hn::Neg(way.w_r)));
    const Floats aside = hn::Mul(hn::Abs(hn::Sub(way.w, way.w_l)), per_w);
    look.r = select(way.from_right, zero, aside);
    look.l = select(way.from_right, aside, zero);
    look.height =
        hn::Add(hn::Sub(way.z, way.z_l), hn::Mul(aside, select(way.from_right, way.z_l, way.z_r)));
    look.clearance = hn::Mul(way.above, per_w);
    Mask out = hn::And(hn::Ge(bound.climb, zero), hn::Ge(look.height, ground.max_height));
    Ints cell = way.cell;
    if (ground.periodic) {
        cell = way.cell = ground.wrap(way.cell);
    } else {
        const Mask beyond = ground.outside(way.cell);
        out = hn::Or(out, beyond);
        cell = only(hn::AndNot(beyond, valid), way.cell);
    }
    Floats slope = ground.steepest;
    if (ground.leaps_pay) slope = hn::Min(ground.horizon(only(alive, cell), bound.sector), slope);
    look.rise = hn::Mul(slope, bound.level);
    look.out = hn::And(alive, hn::Or(out, hn::Gt(bound.climb, look.rise)));
    return look;
}

/// Leaps ahead over as many cells as the horizon of the cell below allows, where that is worth it.
template <class GroundT>
HWY_INLINE void leap(const GroundT& ground, Way& way, const Outlook& look, Floats climb, Mask may) {
    const Floats one = all(1.0f);
    // Length of path on which the clearance is used up, short of rounding
    const Floats closing = hn::Max(hn::Sub(look.rise, climb), all(1e-9f));
    Floats length = hn::Min(hn::Mul(all(0.999f), hn::Div(look.clearance, closing)), all(1e9f));
    const Floats cells = hn::Mul(length, way.across);
    constexpr float kWorthwhile = 4;
    const Mask far = hn::And(may, hn::Gt(cells, all(kWorthwhile)));
    if (hn::AllFalse(kFloat, far)) return;
    if (const Mask too_far = hn::And(far, hn::Gt(cells, ground.longest_leap));
        !hn::AllFalse(kFloat, too_far))
        length = hn::Mul(length, hn::Min(one, hn::Div(ground.longest_leap, cells)));
    const Floats n_r =
        hn::IfThenElseZero(far, hn::Floor(hn::Add(look.r, hn::Mul(length, way.w_l))));
    const Floats n_l =
        hn::IfThenElseZero(far, hn::Floor(hn::Sub(look.l, hn::Mul(length, way.w_r))));
    const Ints there = plus(way.cell, plus(times(hn::ConvertTo(kInt, n_r), way.step_r),
                                           times(hn::ConvertTo(kInt, n_l), way.step_l)));
    way.cell = select(far, ground.periodic ? ground.wrap(there) : there, way.cell);
    const Floats w = hn::Add(way.w, hn::Add(hn::Mul(n_r, way.w_r), hn::Mul(n_l, way.w_l)));
    way.w = select(far, clamp_between(w, way.across), way.w);
    way.z = hn::Add(way.z, hn::Add(hn::Mul(n_r, way.z_r), hn::Mul(n_l, way.z_l)));
    ground.fetch(way.cell, far, way.view.flip_y);
}

/// Appends the lanes that are out, and over finite patches where they are.
template <class GroundT>
HWY_INLINE void pack_leavers(const GroundT& ground, const Way& way, const Outlook& look, Ints ray,
                             Leavers& leavers) {
    if (hn::AllFalse(kFloat, look.out)) return;
    const Packer pack(look.out);
    pack(ray, leavers.ray, leavers.count);
    if (!ground.periodic) {
        const Floats x = select(way.view.along, look.l, look.r),
                     y = select(way.view.along, look.r, look.l);
        const auto place = [](Ints cell, Mask flip, Floats from_near) HWY_ATTR {
            return hn::Add(hn::ConvertTo(kFloat, cell),
                           select(flip, hn::Sub(all(1.0f), from_near), from_near));
        };
        pack(place(x_of(way.cell), way.view.flip_x, x), leavers.at_x, leavers.count);
        pack(place(y_of(way.cell), way.view.flip_y, y), leavers.at_y, leavers.count);
        pack(look.height, leavers.at_z, leavers.count);
    }
    leavers.count += pack.count;
}

/// Writes the lanes that are still under way to `at`; returns how many.
HWY_INLINE std::size_t pack_walkers(Mask going, const Way& way, const Bound& bound,
                                    Walkers& walkers, std::size_t at) {
    const Packer pack(going);
    pack(way.cell, walkers.cell, at);
    pack(way.w, walkers.w, at);
    pack(way.w_l, walkers.w_l, at);
    pack(way.w_r, walkers.w_r, at);
    pack(way.z, walkers.z, at);
    pack(way.z_l, walkers.z_l, at);
    pack(way.z_r, walkers.z_r, at);
    pack(bound.climb, walkers.climb, at);
    pack(bound.level, walkers.level, at);
    pack(bound.sector, walkers.sector, at);
    pack(bound.ray, walkers.ray, at);
    return pack.count;
}

/// Paths that are under way, as they were packed.
HWY_INLINE Setting settled(const Walkers& walkers, std::size_t k) {
    return {load(walkers.cell, k), load(walkers.w, k),      load(walkers.w_l, k),
            load(walkers.w_r, k),  load(walkers.z, k),      load(walkers.z_l, k),
            load(walkers.z_r, k),  load(walkers.climb, k),  load(walkers.level, k),
            hn::Zero(kFloat),      load(walkers.sector, k), load(walkers.ray, k)};
}

/// Where a round begins.
enum class Start { OnFacet, InTheAir, UnderWay };

/// Takes paths, setting_of(k) those from number k on, kCellsPerRound cells further and leaves in
/// `walkers`, side by side, those that are still under way. walkers.count tells how many set out.
template <Start kStart, class GroundT, class SettingOf>
HWY_INLINE void walk_round(const GroundT& ground, SettingOf setting_of, Walkers& walkers,
                           RawHits& hits, Leavers& leavers) {
    const Floats zero = hn::Zero(kFloat), minus_zero = all(-0.0f);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < walkers.count; k += kLanes) {
        const Mask valid = first_lanes(k, walkers.count);
        const Setting setting = setting_of(k);
        const Bound bound{setting.climb, setting.level, only(valid, setting.sector),
                          only(valid, setting.ray)};
        Way way(setting, valid);

        // Walk, and remember the first facet that was hit
        const Ints from = way.cell;
        const Floats w0 = way.w, z0 = way.z;
        FirstHit first{zero, zero, way.cell};
        cross_cell(ground, way, first,
                   kStart == Start::OnFacet    ? minus_zero
                   : kStart == Start::InTheAir ? setting.passed
                                               : zero,
                   kStart == Start::OnFacet ? setting.passed : zero);
        for (int n = 1; n < kCellsPerRound; ++n) cross_cell(ground, way, first, zero, zero);
        const Mask hit = hn::And(valid, negative(first.hit));
        pack_hits(hit, first, from, w0, z0, bound.ray, hits);

        // Out?
        const Mask alive = hn::AndNot(hit, valid);
        const Outlook look = look_around(ground, way, bound, valid, alive);
        pack_leavers(ground, way, look, bound.ray, leavers);

        // Leap ahead
        const Mask going = hn::AndNot(look.out, alive);
        if (ground.leaps_pay) leap(ground, way, look, bound.climb, going);
        kept += pack_walkers(going, way, bound, walkers, kept);
    }
    walkers.count = kept;
}

template <Start kStart, class GroundT>
void set_out_on(const GroundT& ground, const FacetPoints& points, Directions& directions,
                const PerPath<float>* start_height, Walkers& walkers, RawHits& hits,
                Leavers& leavers) {
    walkers.count = points.count;
    walk_round<kStart>(
        ground,
        [&](std::size_t k)
            HWY_ATTR { return set_out(ground, points, directions, start_height, k); },
        walkers, hits, leavers);
}
template <class GroundT>
void walk_on(const GroundT& ground, Walkers& walkers, RawHits& hits, Leavers& leavers) {
    walk_round<Start::UnderWay>(
        ground, [&](std::size_t k) HWY_ATTR { return settled(walkers, k); }, walkers, hits,
        leavers);
}

void Walk(const WideGrid& grid, const FacetPoints& points, Directions& directions,
          const PerPath<float>* start_height, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        if (start_height)
            set_out_on<Start::InTheAir>(ground, points, directions, start_height, walkers, hits,
                                        leavers);
        else
            set_out_on<Start::OnFacet>(ground, points, directions, nullptr, walkers, hits, leavers);
        for (int round = 1; round < most_rounds && walkers.count > 0; ++round)
            walk_on(ground, walkers, hits, leavers);
    });
}

/// Fetches the directions of the paths that are out.
template <Gather kGather>
void release_by(const Leavers& leavers, const Directions& directions, bool with_places,
                Escapes& escapes) {
    const auto append = [&](Floats x, PerPath<float>& to, std::size_t k)
                            HWY_ATTR { hn::StoreU(x, kFloat, to.values + escapes.count + k); };
    for (std::size_t k = 0; k < leavers.count; k += kLanes) {
        const Ints ray = only(first_lanes(k, leavers.count), load(leavers.ray, k));
        const Fields heading = gather_fields<kGather>(directions.headings.values, ray);
        append(heading.a, escapes.x, k);
        append(heading.b, escapes.y, k);
        append(heading.c, escapes.z, k);
        hn::StoreU(hn::BitCast(kInt, heading.d), kInt, escapes.path.values + escapes.count + k);
        if (with_places) {
            append(load(leavers.at_x, k), escapes.at_x, k);
            append(load(leavers.at_y, k), escapes.at_y, k);
            append(load(leavers.at_z, k), escapes.at_z, k);
        }
    }
    escapes.count += leavers.count;
}
void Release(const WideGrid& grid, const Leavers& leavers, const Directions& directions,
             Escapes& escapes) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        release_by<std::decay_t<decltype(ground)>::kGather>(leavers, directions, !ground.periodic,
                                                            escapes);
    });
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
