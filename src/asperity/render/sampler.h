// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace asperity {

/// The random numbers of one path: sample `sample` of pixel `pixel`.
///
/// Each next2() is the next pair of dimensions. Over the samples of a pixel a pair is an
/// Owen-scrambled Sobol sequence in a random order (Burley 2020, "Practical hash-based Owen
/// scrambling"): well spread after every power of two, and unbiased after any number. Pairs and
/// pixels are independent. All belongs to (seed, pixel, sample, dimension) and to nothing else.
class PixelSampler {
  public:
    /// `pixel` = y * width + x.
    PixelSampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample);

    /// In [0, 1)^2.
    std::array<double, 2> next2();

  private:
    std::array<std::uint32_t, 4> key_;  ///< of the pixel, from CounterRandom
    std::uint32_t sample_;              ///< its bits in reverse order
    std::uint32_t dimension_ = 0;
};

}  // namespace asperity
