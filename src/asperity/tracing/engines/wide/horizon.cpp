// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/horizon.h>

#include <asperity/core/parallel.h>
#include <asperity/surface/blocks.h>
#include <asperity/tracing/engines/wide/horizon_block.h>

#include <algorithm>

namespace asperity {

namespace {

using detail::HorizonBlock;

/// 2^shift cells on a side share an entry.
int pool_shift_for(int cells_x, int cells_y) {
    const std::int64_t cells = std::int64_t{cells_x} * cells_y;
    return cells <= 128 * 128 ? 0 : cells <= 4096 * 4096 ? 1 : 2;
}

/// Slope by which rounding, and directions a hair outside their sector, may err.
float safety_margin(const PaddedHeights& heights) {
    const double range = double(heights.max_height()) - double(heights.min_height());
    return static_cast<float>(4e-6 * range / std::min(heights.dx(), heights.dy()));
}

}  // namespace

Horizon::Horizon(const PaddedHeights& heights, Run& run)
    : pool_shift_(pool_shift_for(heights.cells_x(), heights.cells_y())) {
    const int size = 1 << pool_shift_;
    const int blocks_x = (heights.cells_x() + size - 1) >> pool_shift_;
    const int blocks_y = (heights.cells_y() + size - 1) >> pool_shift_;
    // Rows of an odd number of cache lines do not fight for the same place in a cache
    constexpr int kPerLine = 4;
    pitch_ = ((blocks_x + kPerLine - 1) / kPerLine | 1) * kPerLine;
    constexpr int kReadable = 3;
    allocate(bytes_,
             static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(blocks_y) * kSectors +
                 kReadable,
             run);

    const detail::HorizonGeometry geometry(heights.dx(), heights.dy(), HorizonBlock::pitches());
    const detail::TileMaxima maxima(heights, run);
    const float margin = safety_margin(heights);

    constexpr int kCells = HorizonBlock::kCells;
    const int columns = (heights.cells_x() + kCells - 1) / kCells;
    const int rows = (heights.cells_y() + kCells - 1) / kCells;
    const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    parallel_for(count, run.threads(), [&](std::size_t task) {
        throw_if_stopped(run);
        HorizonBlock block;
        const int i0 = static_cast<int>(task) % columns * kCells;
        const int j0 = static_cast<int>(task) / columns * kCells;
        block.load(heights, maxima, i0, j0);
        detail::bound_horizon(geometry, margin, block);

        // Keep the largest byte of the cells that share an entry
        for (int j = 0; j < block.cells_y; ++j) {
            const std::uint8_t* row = &block.bytes[static_cast<std::size_t>(j * kSectors * kCells)];
            std::uint8_t* out = &bytes_[(static_cast<std::size_t>((j0 + j) >> pool_shift_) *
                                             static_cast<std::size_t>(pitch_) +
                                         static_cast<std::size_t>(i0 >> pool_shift_)) *
                                        kSectors];
            for (int i = 0; i < block.cells_x; ++i) {
                std::uint8_t* entry = out + (i >> pool_shift_) * kSectors;
                for (int s = 0; s < kSectors; ++s)
                    entry[s] = std::max(entry[s], row[s * kCells + i]);
            }
        }
        run.advance(static_cast<std::uint64_t>(block.cells_x) *
                    static_cast<std::uint64_t>(block.cells_y));
    });
}

}  // namespace asperity
