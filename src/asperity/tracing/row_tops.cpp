// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/row_tops.h>

#include <asperity/core/parallel.h>
#include <asperity/surface/blocks.h>

#include <algorithm>
#include <limits>

namespace asperity {

RowTops::RowTops(const PaddedHeights& heights, int width, int depth, const Run& run) {
    constexpr float kNothing = -std::numeric_limits<float>::infinity();
    const int nx = heights.cells_x(), ny = heights.cells_y();
    columns_ = (nx + kStride - 1) / kStride;
    const int rows = (ny + kStride - 1) / kStride;
    tops_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows), kNothing);

    // Windows begin anywhere within a stride, so they are larger by that
    parallel_for(static_cast<std::size_t>(rows), run.threads(), [&](std::size_t row) {
        throw_if_stopped(run);
        std::vector<float> column_tops(static_cast<std::size_t>(nx), kNothing);
        const int first = static_cast<int>(row) * kStride;
        for (int y = first; y < first + kStride + depth; ++y) {
            const float* heights_of_row =
                heights.origin() + static_cast<std::ptrdiff_t>(y % ny) * heights.pitch();
            for (int x = 0; x < nx; ++x)
                column_tops[static_cast<std::size_t>(x)] =
                    std::max(column_tops[static_cast<std::size_t>(x)], heights_of_row[x]);
        }
        for (int a = 0; a < columns_; ++a) {
            float top = kNothing;
            for (int x = a * kStride; x < a * kStride + kStride + width; ++x)
                top = std::max(top, column_tops[static_cast<std::size_t>(x % nx)]);
            tops_[row * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(a)] = top;
        }
    });
}

}  // namespace asperity
