// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/row_tops.h>

#include <asperity/core/parallel.h>
#include <asperity/surface/blocks.h>

#include <algorithm>

namespace asperity {

RowTops::RowTops(const PaddedHeights& heights, const Run& run) {
    const int nx = heights.cells_x(), ny = heights.cells_y();
    pitch_ = (nx + kPiece - 1) / kPiece + kPieces;
    const auto rows = static_cast<std::size_t>(ny + kRowsMore);
    allocate(tops_, static_cast<std::size_t>(pitch_) * rows, run);
    parallel_for(rows, run.threads(), [&](std::size_t row) {
        throw_if_stopped(run);
        const int y = static_cast<int>(row) % ny;
        for (std::ptrdiff_t piece = 0; piece < pitch_; ++piece) {
            float top = PaddedHeights::kFarBelow;
            for (int k = 0; k < kPiece; ++k)
                top = std::max(top, heights.at((static_cast<int>(piece) * kPiece + k) % nx, y));
            tops_[row * static_cast<std::size_t>(pitch_) + static_cast<std::size_t>(piece)] = top;
        }
    });
}

}  // namespace asperity
