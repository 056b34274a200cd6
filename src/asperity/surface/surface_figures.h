// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/statistics.h>

#include <span>

namespace asperity {

/// A figure of SurfaceStatistics by its name, as JSON, result files and Python know it.
struct SurfaceFigure {
    const char* name;
    double SurfaceStatistics::*value;
};

/// All of them, in the order of result files: the one list of their names.
std::span<const SurfaceFigure> surface_figures();

}  // namespace asperity
