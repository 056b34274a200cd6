// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/tracing/engines/wide/horizon_terms.h>
#include <asperity/tracing/engines/wide/padded_heights.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity::detail {

/// Heights in units of dx below the highest point, so that neither unit nor offset matter.
struct HeightScale {
    float highest, per_length;
    explicit HeightScale(const PaddedHeights& heights)
        : highest(heights.max_height()), per_length(static_cast<float>(1 / heights.dx())) {}
    float operator()(float height) const { return (height - highest) * per_length; }
};

/// The highest points of all tiles of HorizonReach::kTile cells, [HeightScale]; the last ones are
/// cut off at the surface's end.
struct TileMaxima {
    int columns, rows;
    std::vector<float> highest;

    TileMaxima(const PaddedHeights& heights, const Run& run);
};

/// One level of tiles around the block, and what its viewers need to climb over them.
///
/// The slope needed is a convex function of the viewer's height, so a chord from the viewers'
/// lowest to their highest bounds it: viewers of height h need at_lowest + rise * (h - lowest).
struct HorizonLevel {
    int viewers;  ///< on a side, each a square of cells
    int halo;     ///< tiles on each side of the viewers
    int pitch;
    std::vector<float> tiles;
    /// [row * kRow + column]
    std::vector<float> lowest, highest;
    /// [(row * 16 + sector) * kRow + column]
    std::vector<float> at_lowest, rise;
    static constexpr int kRow = 16;

    HorizonLevel(int viewers_on_a_side, int tiles_around);
    float* origin() { return &tiles[static_cast<std::size_t>(halo * pitch + halo)]; }
};

/// What one thread needs to work on a block of kCells x kCells cells: the surface around it, laid
/// out flat, whatever the period.
struct HorizonBlock {
    static constexpr int kCells = 128;
    static constexpr int kHalo = HorizonReach::kTile * HorizonReach::kTiles;
    static constexpr int kSide = kCells + 2 * kHalo + 1;
    static constexpr int kPitch = (kSide + 15) / 16 * 16 + 16;
    static constexpr int kSectors = 16;

    int cells_x = 0, cells_y = 0;  ///< of the block that lie on the surface
    std::vector<float> samples;    ///< kSide rows
    std::vector<float> windows;    ///< highest point of the window starting at a cell
    std::vector<float> scratch;    ///< one row
    HorizonLevel near_tiles, wide_tiles;
    std::vector<std::uint8_t> bytes;  ///< [(j * kSectors + sector) * kCells + i]

    HorizonBlock();
    /// Offset of sample (i, j) of the block in `samples`.
    static constexpr std::ptrdiff_t at(int i, int j) {
        return static_cast<std::ptrdiff_t>(j + kHalo) * kPitch + i + kHalo;
    }
    static constexpr HorizonGeometry::Pitches pitches() {
        return {2 * HorizonReach::kPlane + 2, kPitch,
                kCells / HorizonReach::kTile + 2 * HorizonReach::kTiles,
                kCells / HorizonReach::kWideTile + 2 * HorizonReach::kWideTiles};
    }
    /// Copies the surface around the cells from (i0, j0) on.
    void load(const PaddedHeights& heights, const TileMaxima& maxima, int i0, int j0);
};

/// Fills in the bytes of all cells of a loaded block, on the widest vectors the machine has.
/// `margin` is added to every slope for rounding.
void bound_horizon(const HorizonGeometry& geometry, float margin, HorizonBlock& block);

}  // namespace asperity::detail
