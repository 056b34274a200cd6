// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/launch_line.h>
#include <asperity/tracing/row_tops.h>
#include <asperity/tracing/wide.h>
#include <asperity/tracing/wide_grid.h>

namespace asperity {

/// Rays that fly side by side.
inline constexpr int kLaunchGroup = 16;

/// Where rays are launched.
struct LaunchPlace {
    const WideGrid* grid;
    const PaddedHeights* heights;
    const RowTops* tops;  ///< windows of kLaunchGroup + kReach by kReach
};

/// Facets are numbered [upper * cells + j * cells_x + i] over a tile of the tracer, in its frame.
/// For light of one direction a caller may know beforehand what becomes of all that falls onto a
/// facet: an answer >= 0, or -1. Tiles less than 2^15 cells wide only.
using FacetAnswers = const std::int32_t*;

/// Rays whose facets had an answer.
struct AnsweredRays {
    std::size_t count = 0;
    PerPath<std::int32_t> answer, facet, ray;
};

/// Rays of one line that have hit: which triangle, as LaunchLine::triangle numbers them, and the
/// packed cell that its vertices are counted from.
struct LaunchHits {
    std::size_t count = 0;
    PerPath<std::int32_t> triangle, cell, ray;
};

}  // namespace asperity
