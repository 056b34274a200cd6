// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/tracing/engines/wide/padded_heights.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// How steeply a path must climb to be free: for every cell and every sixteenth of the compass, a
/// slope that no point of the surface out there exceeds as seen from any point of the surface in
/// the cell. A path that starts on the surface in the cell and climbs more steeply escapes for
/// certain.
///
/// More than that, the surface lies below a cone over every point p of it: height(q) <= height(p) +
/// slope * |q - p| for all q in that sector, so a path that passes above the cell with some
/// clearance may leap ahead without looking. Slopes are rises per horizontal length, >= 0, rounded
/// up; one byte each. Everything in the frame of the padded heights (mirrored x if they are).
class Horizon {
  public:
    static constexpr int kSectors = 16;
    /// Slope of the largest byte but one; byte 255 promises nothing.
    static constexpr float kSteepest = 8.0f;

    /// Tight within some 0.25 RMS slopes on average on smooth surfaces, a fourth of the slope
    /// itself on white noise. Cost: about 500 cycles a cell with AVX2; 1.2 MB of workspace a
    /// thread. The bytes depend neither on the number of threads nor on the instruction set. Calls
    /// run.advance() with the cells done; throws Error(Stopped) once the run is to be stopped.
    Horizon(const PaddedHeights& heights, Run& run);
    Horizon(const PaddedHeights& heights, Run&& run) : Horizon(heights, run) {}
    Horizon(const PaddedHeights& heights, int threads) : Horizon(heights, Run(threads)) {}

    /// Sector of the horizontal direction (x, y), not both zero, in units of length (not cells).
    /// Bit 0: x < 0; bit 1: y < 0; bit 2: |y| > |x|; bit 3: the smaller one of |x|, |y| exceeds
    /// tan(22.5 deg) times the larger one.
    static int sector_of(float x, float y) {
        const float ax = std::fabs(x), ay = std::fabs(y);
        const bool steep = ay > ax;
        const float large = steep ? ay : ax, small = steep ? ax : ay;
        return (x < 0 ? 1 : 0) | (y < 0 ? 2 : 0) | (steep ? 4 : 0) |
               (small > kTanHalf * large ? 8 : 0);
    }
    static constexpr float kTanHalf = 0.41421356f;

    /// The slope a byte stands for: finer near level.
    static float slope_of(std::uint8_t byte) {
        return byte == 255 ? INFINITY : static_cast<float>(byte) * static_cast<float>(byte) * kStep;
    }
    static constexpr float kStep = kSteepest / (254.0f * 254.0f);

    /// Cells share an entry in blocks of 2^pool_shift() x 2^pool_shift(): 0 up to 128 x 128 cells,
    /// 1 up to 4096 x 4096, else 2. A looser bound costs less than an entry that is not in the
    /// cache: measured, docs/performance.md.
    int pool_shift() const { return pool_shift_; }
    /// Blocks from one row of blocks to the next.
    int pitch() const { return pitch_; }
    /// bytes()[(block_j * pitch() + block_i) * kSectors + sector], block = cell >> pool_shift(),
    /// 0 <= cell < cells. Three bytes more may be read at the end.
    const std::uint8_t* bytes() const { return bytes_.data(); }
    std::uint8_t byte(int i, int j, int sector) const {
        return bytes_[(static_cast<std::size_t>(j >> pool_shift_) *
                           static_cast<std::size_t>(pitch_) +
                       static_cast<std::size_t>(i >> pool_shift_)) *
                          kSectors +
                      static_cast<std::size_t>(sector)];
    }
    std::size_t memory_bytes() const { return bytes_.size(); }

  private:
    int pool_shift_ = 0, pitch_ = 0;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace asperity
