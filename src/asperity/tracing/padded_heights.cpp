// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/padded_heights.h>

#include <asperity/core/parallel.h>

#include <algorithm>

namespace asperity {

namespace {

/// Cells of a side of `cells`, repeated until there are enough.
int repeated(int cells, bool periodic) {
    constexpr int kEnough = PaddedHeights::kShortest;
    return periodic && cells < kEnough ? (kEnough + cells - 1) / cells * cells : cells;
}

/// Remainder that is never negative.
int wrap(int index, int count) {
    const int rest = index % count;
    return rest < 0 ? rest + count : rest;
}

}  // namespace

PaddedHeights::PaddedHeights(const Heightfield& s, int threads)
    : cells_x_(repeated(s.cells_x(), s.boundary == Boundary::Periodic)),
      cells_y_(repeated(s.cells_y(), s.boundary == Boundary::Periodic)),
      periodic_(s.boundary == Boundary::Periodic),
      mirrored_(s.diagonal == Diagonal::Main),
      dx_(s.dx),
      dy_(s.dy) {
    // Rows of whole cache lines, an odd number of them
    constexpr int kLine = 16;
    const int columns = cells_x_ + 1 + 2 * kMargin, rows = cells_y_ + 1 + 2 * kMargin;
    const int lines = (columns + kLine - 1) / kLine;
    pitch_ = kLine * (lines % 2 == 0 ? lines + 1 : lines);
    heights_.assign(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows), kFarBelow);

    const auto source_column = [&](int i) { return mirrored_ ? s.cells_x() - i : i; };
    parallel_for(static_cast<std::size_t>(rows), threads, [&](std::size_t row) {
        const int j = static_cast<int>(row) - kMargin;
        float* out = &heights_[row * static_cast<std::size_t>(pitch_)];
        if (periodic_) {
            const int from = wrap(j, s.cells_y());
            for (int k = 0; k < columns; ++k)
                out[k] = s.at(wrap(source_column(k - kMargin), s.cells_x()), from);
        } else if (j >= 0 && j <= cells_y_) {
            for (int i = 0; i <= cells_x_; ++i) out[i + kMargin] = s.at(source_column(i), j);
        }
    });
    const auto [lowest, highest] = std::minmax_element(s.heights.begin(), s.heights.end());
    min_height_ = *lowest;
    max_height_ = *highest;
}

}  // namespace asperity
