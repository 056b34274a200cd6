// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engines/wide/launch_line.h>
#include <asperity/tracing/engines/wide/wide.h>
#include <asperity/tracing/engines/wide/wide_grid.h>

namespace asperity {

/// Lines of rays that are followed side by side.
inline constexpr int kLaunchGroup = 32;

/// Rays of parallel light in neighbouring lines, and how far they have come. Ray n of a line passes
/// (phase + n) * spacing above the line's first ray: as if it started that much further along at
/// the same height.
struct LaunchStripe {
    int first = 0;  ///< where the first line starts, in cells across the lines
    int lines = 0;  ///< at most kLaunchGroup
    // By line
    alignas(64) std::int32_t rays[kLaunchGroup] = {};
    alignas(64) double phase[kLaunchGroup] = {};
    alignas(64) double spacing[kLaunchGroup] = {};
    alignas(64) double per_spacing[kLaunchGroup] = {};  ///< 1 / spacing

    std::size_t round = 0;                             ///< that comes next
    alignas(64) std::int32_t next[kLaunchGroup] = {};  ///< the first ray that has not landed
    /// Rays that enter the round no higher than this have landed.
    alignas(64) float shade[kLaunchGroup] = {};

    /// Rays that have not landed.
    std::uint64_t under_way() const {
        std::int64_t count = 0;
        for (std::size_t k = 0; k < kLaunchGroup; ++k) count += rays[k] - next[k];
        return static_cast<std::uint64_t>(count);
    }
};

/// What a caller knows beforehand of light of one direction: facets on which it is enough to count
/// the rays. A byte a cell over a tile of the tracer, in its frame, with x and y exchanged where
/// WideTracer::lines_along_x; rows go on for kSlack cells. Tiles less than 2^15 cells wide only.
struct CountedFacets {
    static constexpr std::uint8_t kLower = 1;  ///< the cell's lower facet is one of them
    static constexpr std::uint8_t kUpper = 2;
    static constexpr int kSlack = kLaunchGroup + LaunchLine::kReach;

    const std::uint8_t* cells = nullptr;  ///< [j * pitch + i]; null: none
    std::int32_t pitch = 0;
};

/// Rays straight down, from cell (i, j) on, none beyond the end of the tile.
struct LaunchedRow {
    int i, j;
    int count;
};

/// Rays of lines that have hit: which triangle, as LaunchLine::triangles numbers them, the packed
/// cell that its vertices are counted from, and the height at which the ray entered the round.
struct LaunchHits {
    std::size_t count = 0;
    PerPath<std::int32_t> triangle, cell;
    PerPath<float> z;
};

}  // namespace asperity
