// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/surface_settings.h>

namespace asperity {

/// Throws Error(Usage, ..., "name of the setting as on the command line") unless every number lies
/// in its range, whether or not the kind uses it. NaN is in no range.
void check_settings(const SurfaceSettings& settings);

/// The spacing of the samples along x and y: 1 by default; one given value counts for both.
struct CellSize {
    double x = 1, y = 1;
};
CellSize cell_size(const SurfaceSettings& settings);

}  // namespace asperity
