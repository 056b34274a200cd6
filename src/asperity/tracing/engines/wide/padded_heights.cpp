// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/padded_heights.h>

#include <asperity/core/parallel.h>
#include <asperity/surface/blocks.h>

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

PaddedHeights::PaddedHeights(const Heightfield& s, const Run& run)
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
    allocate(heights_, static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows), run);

    find_range(s, run);
    const auto source_column = [&](int i) { return mirrored_ ? s.cells_x() - i : i; };
    parallel_for(static_cast<std::size_t>(rows), run.threads(), [&](std::size_t row) {
        throw_if_stopped(run);
        const int j = static_cast<int>(row) - kMargin;
        float* out = &heights_[row * static_cast<std::size_t>(pitch_)];
        std::fill_n(out, pitch_, kFarBelow);
        if (periodic_) {
            const int from = wrap(j, s.cells_y());
            for (int k = 0; k < columns; ++k)
                out[k] = s.at(wrap(source_column(k - kMargin), s.cells_x()), from) - base_;
        } else if (j >= 0 && j <= cells_y_) {
            for (int i = 0; i <= cells_x_; ++i)
                out[i + kMargin] = s.at(source_column(i), j) - base_;
        }
    });
}

void PaddedHeights::find_range(const Heightfield& s, const Run& run) {
    const auto width = static_cast<std::size_t>(s.nx);
    std::vector<float> lowest(static_cast<std::size_t>(s.ny)), highest(lowest.size());
    for_blocks(s.ny, 16, run, [&](int first, int last) {
        for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last);
             ++row) {
            const float* heights = &s.heights[row * width];
            const auto [low, high] = std::minmax_element(heights, heights + width);
            lowest[row] = *low;
            highest[row] = *high;
        }
    });
    min_height_ = *std::min_element(lowest.begin(), lowest.end());
    max_height_ = *std::max_element(highest.begin(), highest.end());
    // Differences of such heights are exact
    constexpr double kFar = 64;
    const double range = double{max_height_} - double{min_height_};
    const bool far = double{min_height_} > kFar * range || double{-max_height_} > kFar * range;
    if (far) base_ = min_height_;
    min_height_ -= base_;
    max_height_ -= base_;
}

}  // namespace asperity
