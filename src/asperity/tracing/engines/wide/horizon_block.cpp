// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/wide/horizon_block.h>

#include <asperity/core/parallel.h>
#include <asperity/surface/blocks.h>

#include <algorithm>

namespace asperity::detail {

namespace {

/// Where index x of the unrolled surface lies in one of `cells` (wrapped if periodic).
int wrapped(int x, int cells, bool periodic) {
    if (!periodic) return x;
    const int rest = x % cells;
    return rest < 0 ? rest + cells : rest;
}

/// The tiles of an axis that hold the cells [first, first + kWideTile).
std::vector<int> tiles_of(int first, int cells, bool periodic) {
    std::vector<int> result;
    for (int k = 0; k < HorizonReach::kWideTile; ++k) {
        const int cell = wrapped(first + k, cells, periodic);
        if (cell < 0 || cell >= cells) continue;
        const int tile = cell / HorizonReach::kTile;
        if (result.empty() || result.back() != tile) result.push_back(tile);
    }
    return result;
}

/// Copies row `j` of the unrolled surface from column i0 on.
void load_row(const PaddedHeights& heights, int i0, int j, float* out) {
    const HeightScale scale(heights);
    const int cells = heights.cells_x();
    const int row = wrapped(j, heights.cells_y(), heights.periodic());
    std::fill(out, out + HorizonBlock::kPitch, PaddedHeights::kFarBelow);
    if (row < 0 || row > heights.cells_y()) return;
    for (int k = 0; k < HorizonBlock::kSide;) {
        const int i = wrapped(i0 + k, cells, heights.periodic());
        if (i < 0) {
            k = -i0;
            continue;
        }
        if (i > cells) return;
        const int run = std::min(HorizonBlock::kSide - k, cells + 1 - i);
        const float* from =
            heights.origin() + static_cast<std::ptrdiff_t>(row) * heights.pitch() + i;
        for (int n = 0; n < run; ++n) out[k + n] = scale(from[n]);
        k += run;
    }
}

}  // namespace

TileMaxima::TileMaxima(const PaddedHeights& heights, const Run& run) {
    constexpr int kTile = HorizonReach::kTile;
    const HeightScale scale(heights);
    columns = (heights.cells_x() + kTile - 1) / kTile;
    rows = (heights.cells_y() + kTile - 1) / kTile;
    highest.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    parallel_for(static_cast<std::size_t>(rows), run.threads(), [&](std::size_t b) {
        throw_if_stopped(run);
        const int j0 = static_cast<int>(b) * kTile, j1 = std::min(j0 + kTile, heights.cells_y());
        for (int a = 0; a < columns; ++a) {
            const int i0 = a * kTile, i1 = std::min(i0 + kTile, heights.cells_x());
            float most = heights.at(i0, j0);
            for (int j = j0; j <= j1; ++j)
                for (int i = i0; i <= i1; ++i) most = std::max(most, heights.at(i, j));
            highest[b * static_cast<std::size_t>(columns) + static_cast<std::size_t>(a)] =
                scale(most);
        }
    });
}

HorizonLevel::HorizonLevel(int viewers_on_a_side, int tiles_around)
    : viewers(viewers_on_a_side), halo(tiles_around), pitch(viewers + 2 * halo) {
    // Whole vectors are read: some more at the end
    tiles.resize(static_cast<std::size_t>(pitch * pitch + kRow));
    lowest.resize(static_cast<std::size_t>(viewers * kRow));
    highest.resize(lowest.size());
    at_lowest.resize(static_cast<std::size_t>(viewers * HorizonBlock::kSectors * kRow));
    rise.resize(at_lowest.size());
}

HorizonBlock::HorizonBlock()
    : samples(static_cast<std::size_t>(kSide * kPitch)),
      windows(samples.size()),
      scratch(static_cast<std::size_t>(kPitch)),
      near_tiles(kCells / HorizonReach::kTile, HorizonReach::kTiles),
      wide_tiles(kCells / HorizonReach::kWideTile, HorizonReach::kWideTiles),
      bytes(static_cast<std::size_t>(kSectors * kCells * kCells)) {}

void HorizonBlock::load(const PaddedHeights& heights, const TileMaxima& maxima, int i0, int j0) {
    cells_x = std::min(kCells, heights.cells_x() - i0);
    cells_y = std::min(kCells, heights.cells_y() - j0);
    for (int j = 0; j < kSide; ++j)
        load_row(heights, i0 - kHalo, j0 - kHalo + j,
                 &samples[static_cast<std::size_t>(j * kPitch)]);

    constexpr int kSize = HorizonReach::kWideTile;
    const int side = wide_tiles.pitch, halo = wide_tiles.halo;
    std::vector<std::vector<int>> columns;
    for (int a = 0; a < side; ++a)
        columns.push_back(tiles_of(i0 + (a - halo) * kSize, heights.cells_x(), heights.periodic()));
    for (int b = 0; b < side; ++b) {
        const auto rows = tiles_of(j0 + (b - halo) * kSize, heights.cells_y(), heights.periodic());
        for (int a = 0; a < side; ++a) {
            float most = PaddedHeights::kFarBelow;
            for (const int row : rows)
                for (const int column : columns[static_cast<std::size_t>(a)])
                    most = std::max(
                        most,
                        maxima.highest[static_cast<std::size_t>(row * maxima.columns + column)]);
            wide_tiles.tiles[static_cast<std::size_t>(b * side + a)] = most;
        }
    }
}

}  // namespace asperity::detail
