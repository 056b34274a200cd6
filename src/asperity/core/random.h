// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace asperity {

/// Random numbers from a counter: the numbers belong to (seed, stream, index, dimension) and to
/// nothing else, so they do not depend on threads, chunks or the order of the calls.
///
/// Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
class CounterRandom {
  public:
    /// `stream` separates uses of one seed (a layer, a batch, a surface); see streams below.
    constexpr CounterRandom(std::uint64_t seed, std::uint32_t stream)
        : seed_(seed), stream_(stream) {}

    /// Four independent uniform 32-bit words.
    std::array<std::uint32_t, 4> bits(std::uint64_t index, std::uint32_t dimension = 0) const {
        using Philox = r123::Philox4x32;
        const Philox::ctr_type counter = {{static_cast<std::uint32_t>(index),
                                           static_cast<std::uint32_t>(index >> 32), stream_,
                                           dimension}};
        const Philox::key_type key = {
            {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
        const Philox::ctr_type r = Philox()(counter, key);
        return {r[0], r[1], r[2], r[3]};
    }

    /// Two independent uniform 64-bit words.
    std::array<std::uint64_t, 2> bits64(std::uint64_t index, std::uint32_t dimension = 0) const {
        const auto b = bits(index, dimension);
        return {(std::uint64_t{b[1]} << 32) | b[0], (std::uint64_t{b[3]} << 32) | b[2]};
    }

    /// Two independent numbers, uniform in [0, 1) in steps of 2^-53.
    std::array<double, 2> uniform2(std::uint64_t index, std::uint32_t dimension = 0) const {
        const auto b = bits64(index, dimension);
        return {static_cast<double>(b[0] >> 11) * 0x1p-53,
                static_cast<double>(b[1] >> 11) * 0x1p-53};
    }

    /// Two independent standard normal numbers (Box-Muller).
    std::array<double, 2> normal2(std::uint64_t index, std::uint32_t dimension = 0) const {
        const auto u = uniform2(index, dimension);
        const double r = std::sqrt(-2.0 * std::log1p(-u[0]));
        const double phi = 2.0 * std::numbers::pi * u[1];
        return {r * std::cos(phi), r * std::sin(phi)};
    }

  private:
    std::uint64_t seed_;
    std::uint32_t stream_;
};

}  // namespace asperity
