// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/launch_line.h>
#include <asperity/tracing/row_tops.h>
#include <asperity/tracing/wide.h>
#include <asperity/tracing/wide_grid.h>

namespace asperity {

/// Rays that fly side by side.
inline constexpr int kLaunchGroup = 32;

/// Where rays are launched.
struct LaunchPlace {
    const WideGrid* grid;
    const PaddedHeights* heights;
    const RowTops* tops;
};

/// What a caller knows beforehand of light of one direction: facets on which it is enough to count
/// the rays. A byte a cell over a tile of the tracer, in its frame; rows go on for kLaunchGroup
/// cells. Tiles less than 2^15 cells wide only.
struct CountedFacets {
    static constexpr std::uint8_t kLower = 1;  ///< the cell's lower facet is one of them
    static constexpr std::uint8_t kUpper = 2;
    /// A ray that starts above the cell, at the height of the highest point, may meet another one.
    static constexpr std::uint8_t kOpen = 4;

    const std::uint8_t* cells = nullptr;  ///< [j * pitch + i]; null: none
    std::int32_t pitch = 0;
};

/// Rays of a line, from cell (i, j) on, none beyond the end of the tile.
struct LaunchedRow {
    int i, j;
    int count;
    int first;  ///< number of the first ray
};

/// Rays of one line that have hit: which triangle, as LaunchLine::triangle numbers them, and the
/// packed cell that its vertices are counted from.
struct LaunchHits {
    std::size_t count = 0;
    PerPath<std::int32_t> triangle, cell, ray;
};

}  // namespace asperity
