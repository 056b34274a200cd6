// SPDX-License-Identifier: Apache-2.0
//
// Lanes of paths for the kernels of the wide tracer, once for each instruction set. No operation
// fuses or approximates, so every instruction set computes the same bits.

#if defined(ASPERITY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ASPERITY_LANES_INL_H
#undef ASPERITY_LANES_INL_H
#else
#define ASPERITY_LANES_INL_H
#endif

#include <asperity/tracing/engines/wide/wide.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace asperity::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using HalfTag = hn::Repartition<std::int16_t, FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Halves = hn::Vec<HalfTag>;
using Mask = hn::Mask<FloatTag>;
constexpr FloatTag kFloat;
constexpr IntTag kInt;
constexpr HalfTag kHalf;
constexpr std::size_t kLanes = hn::MaxLanes(kFloat);

// Short names, so that the kernels read like their formulas.
HWY_INLINE Floats all(float x) {
    return hn::Set(kFloat, x);
}
HWY_INLINE Ints all(std::int32_t x) {
    return hn::Set(kInt, x);
}
HWY_INLINE Floats load(const PerPath<float>& from, std::size_t k) {
    return hn::Load(kFloat, from.values + k);
}
HWY_INLINE Ints load(const PerPath<std::int32_t>& from, std::size_t k) {
    return hn::Load(kInt, from.values + k);
}
HWY_INLINE void store(Floats x, PerPath<float>& to, std::size_t k) {
    hn::Store(x, kFloat, to.values + k);
}
HWY_INLINE void store(Ints x, PerPath<std::int32_t>& to, std::size_t k) {
    hn::Store(x, kInt, to.values + k);
}
HWY_INLINE Floats select(Mask m, Floats yes, Floats no) {
    return hn::IfThenElse(m, yes, no);
}
HWY_INLINE Ints select(Mask m, Ints yes, Ints no) {
    return hn::IfThenElse(hn::RebindMask(kInt, m), yes, no);
}
HWY_INLINE Ints only(Mask m, Ints x) {
    return hn::IfThenElseZero(hn::RebindMask(kInt, m), x);
}
/// Lanes whose sign bit is set.
HWY_INLINE Mask negative(Floats x) {
    return hn::MaskFromVec(hn::BitCast(kFloat, hn::BroadcastSignBit(hn::BitCast(kInt, x))));
}
/// By the sign bit alone, also of -0 and of what is not a number.
HWY_INLINE Floats select_by_sign(Floats sign, Floats if_set, Floats if_clear) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
    return hn::IfNegativeThenElse(sign, if_set, if_clear);
#else
    return select(negative(sign), if_set, if_clear);
#endif
}
/// k, k + 1, ... Highway's Iota of a variable writes lane by lane and reads the whole at once,
/// which takes longer than a whole kernel may.
HWY_INLINE Ints counting_from(std::int32_t k) {
    return hn::Add(hn::Iota(kInt, 0), all(k));
}
/// The lanes k, k + 1, ... below count.
HWY_INLINE Mask first_lanes(std::size_t k, std::size_t count) {
    return hn::RebindMask(kFloat, hn::Lt(counting_from(static_cast<std::int32_t>(k)),
                                         all(static_cast<std::int32_t>(count))));
}

// Packed vertices
HWY_INLINE Ints plus(Ints a, Ints b) {
    return hn::BitCast(kInt, hn::Add(hn::BitCast(kHalf, a), hn::BitCast(kHalf, b)));
}
HWY_INLINE Ints minus(Ints a, Ints b) {
    return hn::BitCast(kInt, hn::Sub(hn::BitCast(kHalf, a), hn::BitCast(kHalf, b)));
}
/// n times the vertex `a`, |n a| < 2^15.
HWY_INLINE Ints times(Ints n, Ints a) {
    const Ints twice = hn::Or(hn::And(n, all(0xffff)), hn::ShiftLeft<16>(n));
    return hn::BitCast(kInt, hn::Mul(hn::BitCast(kHalf, twice), hn::BitCast(kHalf, a)));
}
HWY_INLINE Ints x_of(Ints vertex) {
    return hn::ShiftRight<16>(hn::ShiftLeft<16>(vertex));
}
HWY_INLINE Ints y_of(Ints vertex) {
    return hn::ShiftRight<16>(vertex);
}
/// x + y * pitch, |pitch| < 2^15.
HWY_INLINE Ints index_of(Ints vertex, std::int32_t pitch) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
    Ints unused = hn::Zero(kInt);
    return hn::ReorderWidenMulAccumulate(kInt, hn::BitCast(kHalf, vertex),
                                         hn::BitCast(kHalf, all(pack_vertex(1, pitch))),
                                         hn::Zero(kInt), unused);
#else
    return hn::Add(x_of(vertex), hn::Mul(y_of(vertex), all(pitch)));
#endif
}

/// How values are brought together that lie apart in memory: with a load for each lane, or with the
/// instructions that some processors have for it, of which some are slow. What is read is the same.
enum class Gather { OneByOne, AtOnce };
#undef ASPERITY_GATHERS_AT_ONCE
#if HWY_TARGET == HWY_AVX3
#define ASPERITY_GATHERS_AT_ONCE 1
#else
#define ASPERITY_GATHERS_AT_ONCE 0
#endif

/// The lanes of a vector in memory, to be read one by one.
struct LaneArray {
    alignas(64) std::int32_t values[kLanes];
    HWY_INLINE explicit LaneArray(Ints x) {
        hn::Store(x, kInt, values);
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
        asm("" : "+m"(values));  // or the compiler takes the vector apart again, which is slower
#endif
    }
    HWY_INLINE std::ptrdiff_t operator[](std::size_t lane) const {
        return values[lane];
    }
};

HWY_INLINE Floats gather(const float* from, Ints index) {
#if HWY_TARGET <= HWY_AVX3
    return hn::GatherIndex(kFloat, from, index);
#else
    // Taken apart by hand: on most processors faster than the gather instruction, which is
    // microcoded or slowed down by mitigations
    const LaneArray at(index);
    alignas(64) float out[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = from[at[lane]];
    return hn::Load(kFloat, out);
#endif
}
/// from[index]; three bytes more may be read.
template <Gather kGather>
HWY_INLINE Ints gather_bytes(const std::uint8_t* from, Ints index) {
#if ASPERITY_GATHERS_AT_ONCE
    if constexpr (kGather == Gather::AtOnce)
        return hn::And(Ints{_mm512_i32gather_epi32(index.raw, from, 1)}, all(0xff));
#endif
    const LaneArray at(index);
    const hn::Rebind<std::uint8_t, IntTag> bytes;
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
    // Two chains of insertions, so that they run side by side
    constexpr std::size_t kHalf = kLanes == 16 ? 8 : kLanes;
    const auto chain = [&](std::size_t first) HWY_ATTR {
        __m128i b = _mm_cvtsi32_si128(from[at[first]]);
        b = _mm_insert_epi8(b, from[at[first + 1]], 1);
        b = _mm_insert_epi8(b, from[at[first + 2]], 2);
        b = _mm_insert_epi8(b, from[at[first + 3]], 3);
        if constexpr (kHalf == 8) {
            b = _mm_insert_epi8(b, from[at[first + 4]], 4);
            b = _mm_insert_epi8(b, from[at[first + 5]], 5);
            b = _mm_insert_epi8(b, from[at[first + 6]], 6);
            b = _mm_insert_epi8(b, from[at[first + 7]], 7);
        }
        return b;
    };
    __m128i all_bytes = chain(0);
    if constexpr (kLanes == 16) all_bytes = _mm_unpacklo_epi64(all_bytes, chain(8));
    return hn::PromoteTo(kInt, hn::Vec<decltype(bytes)>{all_bytes});
#else
    std::uint8_t out[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = from[at[lane]];
    return hn::PromoteTo(kInt, hn::LoadU(bytes, out));
#endif
}

/// Vectors of the four fields of records.
struct Fields {
    Floats a, b, c, d;
};
/// record(lane) for all lanes, each four values: one field of all lanes a vector, by 4 x 4
/// transposes.
template <class Record>
HWY_INLINE Fields fields_of(Record record) {
    // The records of lanes k, k + 4, ... side by side
    const auto row = [&](std::size_t k) HWY_ATTR {
        if constexpr (kLanes == 4) {
            return record(k);
        } else if constexpr (kLanes == 8) {
            return hn::Combine(kFloat, record(k + 4), record(k));
        } else {
            const hn::Half<FloatTag> half;
            return hn::Combine(kFloat, hn::Combine(half, record(k + 12), record(k + 8)),
                               hn::Combine(half, record(k + 4), record(k)));
        }
    };
    const Floats r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    using Pairs = hn::Repartition<double, FloatTag>;
    constexpr Pairs kPair;
    const auto low01 = hn::BitCast(kPair, hn::InterleaveLower(kFloat, r0, r1));
    const auto low23 = hn::BitCast(kPair, hn::InterleaveLower(kFloat, r2, r3));
    const auto high01 = hn::BitCast(kPair, hn::InterleaveUpper(kFloat, r0, r1));
    const auto high23 = hn::BitCast(kPair, hn::InterleaveUpper(kFloat, r2, r3));
    return {hn::BitCast(kFloat, hn::InterleaveLower(kPair, low01, low23)),
            hn::BitCast(kFloat, hn::InterleaveUpper(kPair, low01, low23)),
            hn::BitCast(kFloat, hn::InterleaveLower(kPair, high01, high23)),
            hn::BitCast(kFloat, hn::InterleaveUpper(kPair, high01, high23))};
}

#if ASPERITY_GATHERS_AT_ONCE
/// The first or the second (a, b) of the two values at index[lane] * kScale bytes from `from`, and
/// of those at `other` (c, d).
template <int kScale>
HWY_INLINE Fields gather_pairs(const float* from, const float* other, Ints index) {
    const __m256i low = _mm512_castsi512_si256(index.raw),
                  high = _mm512_extracti64x4_epi64(index.raw, 1);
    const auto pairs = [](const float* base, __m256i at) HWY_ATTR {
        return Floats{_mm512_castpd_ps(_mm512_i32gather_pd(at, base, kScale))};
    };
    const Floats first_low = pairs(from, low), first_high = pairs(from, high),
                 second_low = pairs(other, low), second_high = pairs(other, high);
    return {hn::ConcatEven(kFloat, first_high, first_low),
            hn::ConcatOdd(kFloat, first_high, first_low),
            hn::ConcatEven(kFloat, second_high, second_low),
            hn::ConcatOdd(kFloat, second_high, second_low)};
}
#endif

/// The four 32-bit fields of records[index].
template <Gather kGather, class Record>
HWY_INLINE Fields gather_fields(const Record* records, Ints index) {
    static_assert(sizeof(Record) == 4 * sizeof(float));
#if ASPERITY_GATHERS_AT_ONCE
    if constexpr (kGather == Gather::AtOnce) {
        const float* from = reinterpret_cast<const float*>(records);
        return gather_pairs<8>(from, from + 2, hn::ShiftLeft<1>(index));
    }
#endif
    const LaneArray at(index);
    const hn::CappedTag<float, 4> four;
    return fields_of([&](std::size_t lane) HWY_ATTR {
        return hn::LoadU(four, reinterpret_cast<const float*>(records + at[lane]));
    });
}

/// from[index], the value behind it, and the two that lie `pitch` further: as two pairs.
template <Gather kGather>
HWY_INLINE Fields gather_squares(const float* from, std::ptrdiff_t pitch, Ints index) {
#if ASPERITY_GATHERS_AT_ONCE
    if constexpr (kGather == Gather::AtOnce) return gather_pairs<4>(from, from + pitch, index);
#endif
    const LaneArray at(index);
    const hn::CappedTag<double, 2> two;  // of two values each
    const hn::Half<decltype(two)> one;
    return fields_of([&](std::size_t lane) HWY_ATTR {
        const float* below = from + at[lane];
        const auto pair = [&](const float* values) HWY_ATTR {
            return hn::LoadU(one, reinterpret_cast<const double*>(values));
        };
        return hn::BitCast(hn::CappedTag<float, 4>(),
                           hn::Combine(two, pair(below + pitch), pair(below)));
    });
}

/// Row m of the table lists the lanes of the bit mask m in order.
template <std::size_t kCount>
struct alignas(64) LaneTable {
    std::uint8_t rows[std::size_t{1} << kCount][kCount] = {};
    constexpr LaneTable() {
        for (std::size_t mask = 0; mask < std::size_t{1} << kCount; ++mask) {
            std::size_t k = 0;
            for (std::size_t lane = 0; lane < kCount; ++lane)
                if (mask >> lane & 1) rows[mask][k++] = static_cast<std::uint8_t>(lane);
        }
    }
};
inline constexpr LaneTable<(kLanes <= 8 ? kLanes : 1)> kLaneTable;

/// Writes the chosen lanes of vectors side by side. Their order is made ready once, for all the
/// vectors of a path: to exchange lanes is faster than to compress each vector. Lanes behind the
/// chosen ones are overwritten too.
class Packer {
  public:
    HWY_INLINE explicit Packer(Mask chosen)
        : count(hn::CountTrue(kFloat, chosen)), order_(order_of(chosen)) {}

    HWY_INLINE void operator()(Floats x, PerPath<float>& to, std::size_t at) const {
        hn::StoreU(hn::TableLookupLanes(x, hn::IndicesFromVec(kFloat, order_)), kFloat,
                   to.values + at);
    }
    HWY_INLINE void operator()(Ints x, PerPath<std::int32_t>& to, std::size_t at) const {
        hn::StoreU(hn::TableLookupLanes(x, hn::IndicesFromVec(kInt, order_)), kInt, to.values + at);
    }
    const std::size_t count;

  private:
    HWY_INLINE static Ints order_of(Mask chosen) {
        if constexpr (kLanes <= 8) {
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(kFloat, chosen, bits);
            const hn::Rebind<std::uint8_t, IntTag> bytes;
            return hn::PromoteTo(kInt, hn::LoadU(bytes, kLaneTable.rows[bits[0]]));
        } else {
            return hn::Compress(hn::Iota(kInt, 0), hn::RebindMask(kInt, chosen));
        }
    }
    const Ints order_;
};

}  // namespace asperity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
