// SPDX-License-Identifier: Apache-2.0
//
// Looking up the surface, a vector of vertices or cells at a time.

#if defined(ASPERITY_GROUND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_GROUND_INL_H
#undef ASPERITY_GROUND_INL_H
#else
#define ASPERITY_GROUND_INL_H
#endif

#include <asperity/tracing/engines/wide/lanes-inl.h>
#include <asperity/tracing/engines/wide/wide_grid.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

/// Heights of the corners of cells: (0, 0), (1, 0), (0, 1), (1, 1).
struct CellHeights {
    Floats h00, h10, h01, h11;
};

/// The surface, with its constants in registers. kLongRows: rows of 2^15 samples and more, too long
/// for one packed multiplication.
template <bool kLongRows, Gather kWay>
class Ground {
  public:
    static constexpr Gather kGather = kWay;

    HWY_INLINE explicit Ground(const WideGrid& grid)
        : per_x(all(grid.per_x)),
          per_y(all(grid.per_y)),
          max_height(all(grid.max_height)),
          steepest(all(grid.steepest)),
          longest_leap(all(grid.longest_leap)),
          periodic(grid.periodic),
          horizon_pays(grid.horizon_pays),
          leaps_pay(grid.leaps_pay),
          middle_(grid.middle),
          pitch_(grid.pitch),
          horizon_(grid.horizon),
          horizon_pitch_(grid.horizon_pitch),
          pool_shift_(grid.pool_shift),
          first_(all(pack_vertex(-grid.middle_x, -grid.middle_y))),
          last_(
              all(pack_vertex(grid.cells_x - grid.middle_x - 1, grid.cells_y - grid.middle_y - 1))),
          cells_(all(pack_vertex(grid.cells_x, grid.cells_y))) {}

    /// Heights of the corners of a cell on the surface or in its margin.
    HWY_INLINE CellHeights corners(Ints cell) const {
        const Fields f = gather_squares<kGather>(middle_, pitch_, sample_of(cell));
        return {f.a, f.b, f.c, f.d};
    }
    /// Fetches into the cache what the paths of some lanes will see that go on from `cell`.
    HWY_INLINE void fetch(Ints cell, Mask lanes, Mask to_small_y) const {
        alignas(64) std::int32_t sample[kLanes], row[kLanes], entry[kLanes];
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(kFloat, lanes, bits);
        hn::Store(sample_of(cell), kInt, sample);
        hn::Store(select(to_small_y, all(-pitch_), all(pitch_)), kInt, row);
        hn::Store(entry_of(cell), kInt, entry);
        for (unsigned left = bits[0] | unsigned{bits[1]} << 8; left != 0; left &= left - 1) {
            const auto lane = static_cast<unsigned>(__builtin_ctz(left));
            const float* at = middle_ + std::ptrdiff_t{sample[lane]};
            for (int n = 0; n < 4; ++n) __builtin_prefetch(at + n * std::ptrdiff_t{row[lane]});
            __builtin_prefetch(horizon_ + entry[lane]);
        }
    }

    /// The same vertex, or cell, inside the first tile; at most one tile away from it.
    HWY_INLINE Ints wrap(Ints vertex) const {
        const Halves v = hn::BitCast(kHalf, vertex), cells = hn::BitCast(kHalf, cells_);
        const auto below = hn::Lt(v, hn::BitCast(kHalf, first_));
        const auto above = hn::Gt(v, hn::BitCast(kHalf, last_));
        return hn::BitCast(kInt, hn::Sub(hn::Add(v, hn::IfThenElseZero(below, cells)),
                                         hn::IfThenElseZero(above, cells)));
    }
    /// Lanes whose cell is not one of a finite patch.
    HWY_INLINE Mask outside(Ints cell) const {
        const Halves c = hn::BitCast(kHalf, cell);
        const auto out =
            hn::Or(hn::Lt(c, hn::BitCast(kHalf, first_)), hn::Gt(c, hn::BitCast(kHalf, last_)));
        const Ints any = hn::BitCast(kInt, hn::VecFromMask(kHalf, out));
        return hn::RebindMask(kFloat, hn::Ne(any, hn::Zero(kInt)));
    }

    /// The slope above which nothing rises in this sector as seen from `cell`, which is inside.
    HWY_INLINE Floats horizon(Ints cell, Ints sector) const {
        const Ints at = hn::Add(entry_of(cell), sector);
        const Floats byte = hn::ConvertTo(kFloat, gather_bytes<kGather>(horizon_, at));
        const Floats slope = hn::Mul(hn::Mul(byte, byte), all(Horizon::kStep));
        return select(hn::Gt(byte, all(254.5f)), all(1e30f), slope);
    }

    const Floats per_x, per_y, max_height, steepest, longest_leap;
    const bool periodic, horizon_pays, leaps_pay;

  private:
    HWY_INLINE Ints entry_of(Ints cell) const {
        Ints block = cell;
        if (pool_shift_ > 0)
            block = hn::BitCast(kInt, hn::ShiftRightSame(hn::BitCast(kHalf, cell), pool_shift_));
        return hn::ShiftLeft<4>(index_of(block, horizon_pitch_));
    }
    HWY_INLINE Ints sample_of(Ints vertex) const {
        if constexpr (!kLongRows) {
            return index_of(vertex, pitch_);
        } else {
            const Ints row = hn::And(vertex, all(~0xffff));
            const std::int32_t half = pitch_ / 2;
            return hn::Add(index_of(vertex, half), index_of(row, half));
        }
    }

    const float* middle_;
    const std::int32_t pitch_;
    const std::uint8_t* horizon_;
    const std::int32_t horizon_pitch_;
    const int pool_shift_;
    const Ints first_, last_, cells_;
};

/// Calls work(ground) with the ground that fits the grid and the processor.
template <class Work>
HWY_INLINE void on_ground(const WideGrid& grid, Work work) {
    if (grid.pitch >= 1 << 15) {
        work(Ground<true, Gather::OneByOne>(grid));
        return;
    }
#if ASPERITY_GATHERS_AT_ONCE
    if (grid.gathers_pay) {
        work(Ground<false, Gather::AtOnce>(grid));
        return;
    }
#endif
    work(Ground<false, Gather::OneByOne>(grid));
}

/// Horizon::sector_of.
HWY_INLINE Ints sector_of(Floats x, Floats y) {
    const Floats ax = hn::Abs(x), ay = hn::Abs(y), zero = hn::Zero(kFloat);
    const Floats large = hn::Max(ax, ay), small = hn::Min(ax, ay);
    const auto bit = [](Mask m, std::int32_t value) HWY_ATTR { return only(m, all(value)); };
    const Mask half = hn::Gt(small, hn::Mul(all(Horizon::kTanHalf), large));
    return hn::Or(hn::Or(bit(hn::Lt(x, zero), 1), bit(hn::Lt(y, zero), 2)),
                  hn::Or(bit(hn::Gt(ay, ax), 4), bit(half, 8)));
}

/// The line of a path in the plane, in cells, and its height beside the line: a plane through the
/// path that is level across it. Height changes by k_x, k_y per cell.
struct Line {
    Floats du, dv;
    Floats k_x, k_y;
    Floats rate;  ///< k_x = du * rate, k_y = dv * rate
};
template <class GroundT>
HWY_INLINE Line line_of(const GroundT& ground, Floats x, Floats y, Floats z) {
    const Floats du = hn::Mul(x, ground.per_x), dv = hn::Mul(y, ground.per_y);
    const Floats rate = hn::Div(z, hn::Add(hn::Mul(du, du), hn::Mul(dv, dv)));
    return {du, dv, hn::Mul(du, rate), hn::Mul(dv, rate), rate};
}

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
