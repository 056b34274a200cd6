// SPDX-License-Identifier: Apache-2.0
// Numbers that are nearly known, as what is left of them beside a guess. docs/formats.md, "What is
// left out". All of it modulo 2^64 or 2^128, and in f64 by single operations, so that every machine
// has the same bits.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace asperity::io {

__extension__ using Wide = unsigned __int128;
__extension__ using SignedWide = __int128;

inline SignedWide as_signed(Wide x) {
    return static_cast<SignedWide>(x);
}
inline std::int64_t as_signed(std::uint64_t x) {
    return static_cast<std::int64_t>(x);
}

/// Numbers around 0 as small ones without a sign: 0, -1, 1, -2 ...
inline std::uint64_t folded(std::uint64_t x) {
    return (x << 1) ^ (0 - (x >> 63));
}
inline Wide folded(Wide x) {
    return (x << 1) ^ (0 - (x >> 127));
}
template <class Number>
Number unfolded(Number x) {
    return (x >> 1) ^ (0 - (x & 1));
}

/// Rests of numbers that are all multiples of 2^zeros, fewer than the bits of a number.
template <class Number>
Number rest_of(Number right, Number guess, unsigned zeros) {
    return folded(static_cast<Number>(as_signed(right) >> zeros) -
                  static_cast<Number>(as_signed(guess) >> zeros));
}
template <class Number>
Number from_rest(Number rest, Number guess, unsigned zeros) {
    return (unfolded(rest) + static_cast<Number>(as_signed(guess) >> zeros)) << zeros;
}

/// 2 to this power divides a number of these bits, and all others that were put together with it.
inline unsigned zeros_of(std::uint64_t bits) {
    return bits == 0 ? 0 : static_cast<unsigned>(std::countr_zero(bits));
}
inline unsigned zeros_of(Wide bits) {
    const auto low = static_cast<std::uint64_t>(bits),
               high = static_cast<std::uint64_t>(bits >> 64);
    return low == 0 && high != 0 ? 64 + zeros_of(high) : zeros_of(low);
}

/// The nearest whole number towards 0; 0 where there is none of so many bits.
inline Wide whole(double x) {
    if (std::abs(x) < 0x1p62) return static_cast<Wide>(static_cast<std::int64_t>(x));
    if (!(std::abs(x) < 0x1p126)) return 0;
    // A whole number already: 53 bits and a power of 2
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const Wide size = Wide{(bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52)}
                      << ((bits >> 52 & 0x7ff) - 1023 - 52);
    return x < 0 ? 0 - size : size;
}
inline std::uint64_t whole64(double x) {
    return std::abs(x) < 0x1p62 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(x)) : 0;
}

}  // namespace asperity::io
