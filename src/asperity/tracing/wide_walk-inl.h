// SPDX-License-Identifier: Apache-2.0
//
// The walk from facet to facet, the heart of the program. docs/performance.md, "The walk".
//
// A path goes along a strip of rhombi, two triangles each, that hang together by edges (A, B): A
// left of the path, B = A + step_x - step_y right of it. C = A + step_x = B + step_y is the vertex
// opposite. The path crosses the rhombus' second triangle A, B, C and leaves it through the side
// edge (A, C) or (C, B); then the first triangle of the next rhombus, A' - step_y, A', B', through
// (A', B'). With w the distance of a vertex from the path's line and g the height of the surface
// over the path there, the surface under the path at an edge (L, R) rises above it just when
// g_L w_R - g_R w_L < 0, as w_L >= 0 > w_R. No division, no epsilon, every edge once.

#if defined(ASPERITY_WIDE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_WIDE_WALK_INL_H
#undef ASPERITY_WIDE_WALK_INL_H
#else
#define ASPERITY_WIDE_WALK_INL_H
#endif

#include <asperity/tracing/wide_leave-inl.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// Paths in the lanes of a vector, at the edge (A, B) of their strip.
struct Strip {
    Ints a, step_x, step_y, step_ab;
    Floats w_a, w_b, w_x, w_y, w_ab;
    Floats z_a, z_x, z_y, z_ab;
    Floats g_a, g_b;
    Floats above;  ///< g_a w_b - g_b w_a: clearance times w_a - w_b

    HWY_INLINE Strip(const Walkers& from, std::size_t k, Mask valid)
        : a(only(valid, load(from.a, k))),
          step_x(only(valid, load(from.step_x, k))),
          step_y(only(valid, load(from.step_y, k))),
          step_ab(minus(step_x, step_y)),
          w_a(load(from.w, k)),
          w_x(load(from.w_x, k)),
          w_y(load(from.w_y, k)),
          w_ab(hn::Sub(w_x, w_y)),
          z_a(load(from.z, k)),
          z_x(load(from.z_x, k)),
          z_y(load(from.z_y, k)),
          z_ab(hn::Sub(z_x, z_y)),
          g_a(load(from.g_a, k)),
          g_b(load(from.g_b, k)) {
        w_b = hn::Add(w_a, w_ab);
        above = at_edge(g_a, w_a, g_b, w_b);
    }

    HWY_INLINE static Floats at_edge(Floats g_l, Floats w_l, Floats g_r, Floats w_r) {
        return hn::Sub(hn::Mul(g_l, w_r), hn::Mul(g_r, w_l));
    }
};

/// The first hit of each lane: negative `hit` says there was one, in the second triangle of the
/// rhombus at `a` if `in_second` is negative, else in the first.
struct FirstHit {
    Floats hit;
    Floats in_second;
    Ints a;

    HWY_INLINE void note(Floats above, Ints at) {
        a = hn::BitCast(kInt, select_by_sign(hit, hn::BitCast(kFloat, a), hn::BitCast(kFloat, at)));
        hit = hn::Or(hit, above);
    }
    HWY_INLINE void note_second(Floats above, Ints at) {
        in_second = select_by_sign(hit, in_second, above);
        note(above, at);
    }
};

/// Goes to the same edge of the next rhombus, over two edges.
template <class GroundT>
HWY_INLINE void step(const GroundT& ground, Strip& s, FirstHit& first, Floats spared) {
    // C, and on which side of the path it lies
    const Floats w_c = hn::Add(s.w_a, s.w_x);
    const Floats g_c = hn::Sub(ground.height(plus(s.a, s.step_x)), hn::Add(s.z_a, s.z_x));
    const Mask right = negative(w_c);
    // Out of the second triangle: over (A, C) or (C, B)
    const Floats side = Strip::at_edge(select(right, s.g_a, g_c), select(right, s.w_a, w_c),
                                       select(right, g_c, s.g_b), select(right, w_c, s.w_b));
    first.note_second(hn::AndNot(spared, side), s.a);
    // Out of the first triangle of the next rhombus: over (A', B')
    s.a = plus(s.a, select(right, s.step_y, s.step_x));
    s.w_a = hn::Add(s.w_a, select(right, s.w_y, s.w_x));
    s.z_a = hn::Add(s.z_a, select(right, s.z_y, s.z_x));
    s.w_b = hn::Add(s.w_a, s.w_ab);
    const Ints fresh =
        plus(s.a, hn::AndNot(hn::BitCast(kInt, hn::VecFromMask(kFloat, right)), s.step_ab));
    const Floats z_fresh = hn::Add(s.z_a, hn::IfThenZeroElse(right, s.z_ab));
    const Floats g_fresh = hn::Sub(ground.height(fresh), z_fresh);
    s.g_a = select(right, g_fresh, g_c);
    s.g_b = select(right, g_c, g_fresh);
    s.above = Strip::at_edge(s.g_a, s.w_a, s.g_b, s.w_b);
    first.note(s.above, s.a);
}

/// Leaps ahead over as many rhombi as the horizon of the cell below allows, where that is worth
/// it. `rise` is what the horizon may climb per length of path. Returns the lanes that leapt.
template <class GroundT>
HWY_INLINE Mask leap(const GroundT& ground, Strip& s, Mask may, Floats rise, Floats climb,
                     Floats per_w) {
    const Floats one = all(1.0f);
    // Length of path on which the clearance is used up, short of rounding
    const Floats clearance = hn::Mul(s.above, per_w);
    const Floats closing = hn::Max(hn::Sub(rise, climb), all(1e-9f));
    const Floats length = hn::Min(hn::Mul(all(0.999f), hn::Div(clearance, closing)), all(1e9f));
    // In rhombi: the path runs along w_y step_x - w_x step_y
    Floats along_x = hn::Mul(s.w_y, length), along_y = hn::Mul(hn::Neg(s.w_x), length);
    const Floats rhombi = hn::Add(along_x, along_y);
    constexpr float kWorthwhile = 4;
    const Mask far = hn::And(may, hn::Gt(rhombi, all(kWorthwhile)));
    if (hn::AllFalse(kFloat, far)) return far;

    const Floats shorter = hn::Min(one, hn::Div(ground.longest_leap, rhombi));
    along_x = hn::Mul(along_x, shorter);
    along_y = hn::Mul(along_y, shorter);
    const Floats beside_a = hn::Mul(s.w_a, per_w);
    const Floats n_x = hn::IfThenElseZero(far, hn::Floor(hn::Add(beside_a, along_x)));
    const Floats n_y = hn::IfThenElseZero(far, hn::Floor(hn::Add(hn::Sub(one, beside_a), along_y)));
    const Ints there = plus(s.a, plus(times(hn::ConvertTo(kInt, n_x), s.step_x),
                                      times(hn::ConvertTo(kInt, n_y), s.step_y)));
    const Ints a = only(far, ground.periodic ? ground.wrap(there) : there);
    const Floats w = hn::Add(s.w_a, hn::Add(hn::Mul(n_x, s.w_x), hn::Mul(n_y, s.w_y)));
    const Floats z = hn::Add(s.z_a, hn::Add(hn::Mul(n_x, s.z_x), hn::Mul(n_y, s.z_y)));
    s.a = select(far, a, s.a);
    s.w_a = select(far, clamp_between(w, s.w_ab), s.w_a);
    s.w_b = hn::Add(s.w_a, s.w_ab);
    s.z_a = select(far, z, s.z_a);
    s.g_a = select(far, hn::Sub(ground.height(a), z), s.g_a);
    s.g_b = select(far, hn::Sub(ground.height(plus(a, s.step_ab)), hn::Add(z, s.z_ab)), s.g_b);
    s.above = select(far, Strip::at_edge(s.g_a, s.w_a, s.g_b, s.w_b), s.above);
    return far;
}

/// What paths carry along beside their place on the strip.
struct Bound {
    Floats climb, level;
    Ints sector, ray;
};

/// A triangle that was hit, the second of the rhombus at `a` or the first, and the line of the path
/// beside a vertex.
struct Fall {
    Ints a;
    Floats in_second;
    Ints beside;
    Floats w, z;
};

/// Appends the lanes that have hit.
HWY_INLINE void pack_hits(Mask hit, const Strip& s, const Fall& fall, Ints ray, RawHits& hits) {
    if (hn::AllFalse(kFloat, hit)) return;
    const Packer pack(hit);
    pack(fall.a, hits.a, hits.count);
    pack(s.step_x, hits.step_x, hits.count);
    pack(s.step_y, hits.step_y, hits.count);
    pack(fall.beside, hits.beside, hits.count);
    pack(fall.in_second, hits.in_second, hits.count);
    pack(fall.w, hits.w, hits.count);
    pack(fall.z, hits.z, hits.count);
    pack(ray, hits.ray, hits.count);
    hits.count += pack.count;
}

/// What paths see when they look around: which are out, above everything or beyond the horizon.
struct Outlook {
    Mask out;
    Floats rise;      ///< the surface ahead rises no more than this per length of path
    Floats per_w;     ///< lengths of path, seen from above, per distance between A and B
    Floats beside_a;  ///< of the way from A to B
    Floats here;      ///< height of the path
};

/// Looks around, and brings the strip back to the first tile.
template <class GroundT>
HWY_INLINE Outlook look_around(const GroundT& ground, Strip& s, const Bound& bound, Mask valid,
                               Mask alive) {
    Outlook look;
    look.per_w = hn::Div(all(1.0f), hn::Sub(s.w_a, s.w_b));
    look.beside_a = hn::Mul(s.w_a, look.per_w);
    look.here = hn::Add(s.z_a, hn::Mul(look.beside_a, s.z_ab));
    Ints cell = smaller(s.a, plus(s.a, s.step_ab));
    Mask out = hn::And(hn::Ge(bound.climb, hn::Zero(kFloat)), hn::Ge(look.here, ground.max_height));
    if (ground.periodic) {
        s.a = ground.wrap(s.a);
        cell = ground.wrap(cell);
    } else {
        const Mask beyond = ground.outside(cell);
        out = hn::Or(out, beyond);
        cell = only(hn::AndNot(beyond, valid), cell);
    }
    Floats slope = ground.steepest;
    if (ground.leaps_pay) slope = hn::Min(ground.horizon(only(alive, cell), bound.sector), slope);
    look.rise = hn::Mul(slope, bound.level);
    look.out = hn::And(alive, hn::Or(out, hn::Gt(bound.climb, look.rise)));
    return look;
}

/// Appends the lanes that are out, and over finite patches where they are.
template <class GroundT>
HWY_INLINE void pack_leavers(const GroundT& ground, const Strip& s, const Outlook& look, Ints ray,
                             Leavers& leavers) {
    if (hn::AllFalse(kFloat, look.out)) return;
    const Packer pack(look.out);
    pack(ray, leavers.ray, leavers.count);
    if (!ground.periodic) {
        const Ints b = plus(s.a, s.step_ab);
        const auto between = [&](Ints at_a, Ints at_b) HWY_ATTR {
            return hn::Add(hn::ConvertTo(kFloat, at_a),
                           hn::Mul(look.beside_a, hn::ConvertTo(kFloat, hn::Sub(at_b, at_a))));
        };
        pack(between(x_of(s.a), x_of(b)), leavers.at_x, leavers.count);
        pack(between(y_of(s.a), y_of(b)), leavers.at_y, leavers.count);
        pack(look.here, leavers.at_z, leavers.count);
    }
    leavers.count += pack.count;
}

/// Writes the lanes that are still under way to `at`; returns how many.
HWY_INLINE std::size_t pack_walkers(Mask going, const Strip& s, const Bound& bound,
                                    Walkers& walkers, std::size_t at) {
    const Packer pack(going);
    pack(s.a, walkers.a, at);
    pack(s.step_x, walkers.step_x, at);
    pack(s.step_y, walkers.step_y, at);
    pack(s.w_a, walkers.w, at);
    pack(s.w_x, walkers.w_x, at);
    pack(s.w_y, walkers.w_y, at);
    pack(s.z_a, walkers.z, at);
    pack(s.z_x, walkers.z_x, at);
    pack(s.z_y, walkers.z_y, at);
    pack(s.g_a, walkers.g_a, at);
    pack(s.g_b, walkers.g_b, at);
    pack(bound.climb, walkers.climb, at);
    pack(bound.level, walkers.level, at);
    pack(bound.sector, walkers.sector, at);
    pack(bound.ray, walkers.ray, at);
    return pack.count;
}

/// Where a round begins.
enum class Start { OnFacet, InTheAir, UnderWay };

/// Takes every path `kSteps` rhombi further and leaves in `walkers`, side by side, those that are
/// still under way.
template <Start kStart, int kSteps, class GroundT>
void walk_round(const GroundT& ground, Walkers& walkers, RawHits& hits, Leavers& leavers) {
    const Floats zero = hn::Zero(kFloat);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < walkers.count; k += kLanes) {
        const Mask valid = first_lanes(k, walkers.count);
        Strip s(walkers, k, valid);
        const Ints ray = only(valid, load(walkers.ray, k));

        // Walk, and remember the first triangle that was hit
        const Ints a0 = s.a;
        const Floats w0 = s.w_a, z0 = s.z_a;
        FirstHit first{kStart == Start::InTheAir ? s.above : zero, zero, s.a};
        step(ground, s, first, kStart == Start::OnFacet ? load(walkers.spared, k) : zero);
        for (int n = 1; n < kSteps; ++n) step(ground, s, first, zero);
        const Mask hit = hn::And(valid, negative(first.hit));
        pack_hits(hit, s, {first.a, first.in_second, a0, w0, z0}, ray, hits);

        // Out?
        const Mask alive = hn::AndNot(hit, valid);
        const Bound bound{load(walkers.climb, k), load(walkers.level, k),
                          only(valid, load(walkers.sector, k)), ray};
        const Outlook look = look_around(ground, s, bound, valid, alive);
        pack_leavers(ground, s, look, ray, leavers);

        // Leap ahead; the edge landed at is tested like any other
        Mask going = hn::AndNot(look.out, alive);
        if (ground.leaps_pay) {
            const Mask leapt = leap(ground, s, going, look.rise, bound.climb, look.per_w);
            const Mask fell = hn::And(leapt, hn::Lt(s.above, zero));
            pack_hits(fell, s, {s.a, zero, s.a, s.w_a, s.z_a}, ray, hits);
            going = hn::AndNot(fell, going);
        }
        kept += pack_walkers(going, s, bound, walkers, kept);
    }
    walkers.count = kept;
}

template <class GroundT>
void walk_on(const GroundT& ground, bool from_above, int most_rounds, Walkers& walkers,
             RawHits& hits, Leavers& leavers) {
    // The first look around comes early: most paths end near their facet
    if (from_above)
        walk_round<Start::InTheAir, kRhombiPerRound>(ground, walkers, hits, leavers);
    else
        walk_round<Start::OnFacet, kRhombiPerRound / 2>(ground, walkers, hits, leavers);
    for (int round = 1; round < most_rounds && walkers.count > 0; ++round)
        walk_round<Start::UnderWay, kRhombiPerRound>(ground, walkers, hits, leavers);
}
void Walk(const WideGrid& grid, bool from_above, int most_rounds, Walkers& walkers, RawHits& hits,
          Leavers& leavers) {
    on_ground(grid, [&](const auto& ground) HWY_ATTR {
        walk_on(ground, from_above, most_rounds, walkers, hits, leavers);
    });
}

/// Fetches the directions of the paths that are out.
void Release(const Leavers& leavers, const Directions& directions, bool with_places,
             Escapes& escapes) {
    const auto append = [&](Floats x, PerPath<float>& to, std::size_t k)
                            HWY_ATTR { hn::StoreU(x, kFloat, to.values + escapes.count + k); };
    for (std::size_t k = 0; k < leavers.count; k += kLanes) {
        const Ints ray = only(first_lanes(k, leavers.count), load(leavers.ray, k));
        append(gather(directions.x, ray), escapes.x, k);
        append(gather(directions.y, ray), escapes.y, k);
        append(gather(directions.z, ray), escapes.z, k);
        hn::StoreU(gather(directions.path, ray), kInt, escapes.path.values + escapes.count + k);
        if (with_places) {
            append(load(leavers.at_x, k), escapes.at_x, k);
            append(load(leavers.at_y, k), escapes.at_y, k);
            append(load(leavers.at_z, k), escapes.at_z, k);
        }
    }
    escapes.count += leavers.count;
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
