// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/padded_heights.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// The highest points of short pieces of rows of samples: what rays launched side by side may meet
/// on a piece of their way. Rays above all of them fly on without looking.
///
/// Memory: half a byte a cell. Periodic surfaces only.
class RowTops {
  public:
    static constexpr int kPiece = 8;      ///< samples of a piece
    static constexpr int kPieces = 8;     ///< that may be read from one on
    static constexpr int kRowsMore = 16;  ///< rows that may be read beyond the tile

    /// Throws Error(Stopped) once the run is to be stopped.
    RowTops(const PaddedHeights& heights, const Run& run);

    /// The piece that sample (x, y) is in, and kPieces - 1 more, together the samples x + 0 ..
    /// x + kPiece * (kPieces - 1) and some beside them; 0 <= x < cells_x, 0 <= y < cells_y +
    /// kRowsMore. The next row is pitch() further.
    const float* from(int x, int y) const {
        return tops_.data() + static_cast<std::ptrdiff_t>(y) * pitch_ + x / kPiece;
    }
    std::ptrdiff_t pitch() const { return pitch_; }
    std::size_t memory_bytes() const { return tops_.size() * sizeof(float); }

  private:
    std::ptrdiff_t pitch_ = 0;
    std::vector<float> tops_;
};

}  // namespace asperity
