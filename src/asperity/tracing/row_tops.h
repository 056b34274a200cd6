// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/padded_heights.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// The highest points of overlapping windows of the surface: what a group of rays launched side by
/// side can meet during one round. A ray above the top of its window flies on without looking.
///
/// Memory: 4 bytes per 64 cells. Periodic surfaces only.
class RowTops {
  public:
    static constexpr int kStride = 8;  ///< cells from window to window

    /// A window that begins at cell (i, j) holds the samples up to (i + width, j + depth).
    /// Throws Error(Stopped) once the run is to be stopped.
    RowTops(const PaddedHeights& heights, int width, int depth, const Run& run);

    /// At least the highest sample (x, y) with i <= x <= i + width, j <= y <= j + depth;
    /// 0 <= i < cells_x, 0 <= j < cells_y.
    float top(int i, int j) const {
        return tops_[static_cast<std::size_t>(j / kStride) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(i / kStride)];
    }
    std::size_t memory_bytes() const { return tops_.size() * sizeof(float); }

  private:
    int columns_ = 0;
    std::vector<float> tops_;
};

}  // namespace asperity
