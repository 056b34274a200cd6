// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// A heightfield laid out for the wide march: a copy with kMargin samples of the neighbouring tiles
/// on every side, so that a walk of a few cells never has to ask where the tile ends.
///
/// Always with Diagonal::Anti: a surface with the main diagonal is copied mirrored in x, and
/// `mirrored()` says so; whoever uses it mirrors the x of directions and positions. A tile shorter
/// than kShortest cells is repeated until it is long enough, so cells_x() may be a multiple of the
/// surface's. The margin of a finite patch lies at kFarBelow: nothing is ever hit there.
///
/// Heights that lie far from zero, as seen from each other, are counted from base(), where single
/// precision tells them apart as well as it did; else base() is 0.
class PaddedHeights {
  public:
    static constexpr int kMargin = 48;
    static constexpr int kShortest = 64;
    static constexpr float kFarBelow = -1e30f;

    /// Throws Error(Stopped) once the run is to be stopped.
    PaddedHeights(const Heightfield& surface, const Run& run);
    PaddedHeights(const Heightfield& surface, int threads) : PaddedHeights(surface, Run(threads)) {}

    int cells_x() const { return cells_x_; }
    int cells_y() const { return cells_y_; }
    bool periodic() const { return periodic_; }
    bool mirrored() const { return mirrored_; }
    double dx() const { return dx_; }
    double dy() const { return dy_; }
    /// Height of the surface that is 0 here; all other heights are above it.
    float base() const { return base_; }
    float max_height() const { return max_height_; }
    float min_height() const { return min_height_; }

    /// Samples from one row to the next. Not a power of two, so that rows do not fight for the same
    /// cache lines.
    int pitch() const { return pitch_; }
    /// Sample (0, 0). Sample (i, j) is at origin()[j * pitch() + i] for -kMargin <= i <= cells_x()
    /// + kMargin, the same for j.
    const float* origin() const {
        return heights_.data() + static_cast<std::ptrdiff_t>(kMargin) * pitch_ + kMargin;
    }
    float at(int i, int j) const { return origin()[static_cast<std::ptrdiff_t>(j) * pitch_ + i]; }
    std::size_t memory_bytes() const { return heights_.size() * sizeof(float); }

  private:
    void find_range(const Heightfield& surface, const Run& run);

    int cells_x_, cells_y_, pitch_ = 0;
    bool periodic_, mirrored_;
    double dx_, dy_;
    float base_ = 0, max_height_ = 0, min_height_ = 0;
    std::vector<float> heights_;
};

}  // namespace asperity
