// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/surface_settings.h>

#include <string>
#include <vector>

namespace asperity::bench {

/// The surfaces of docs/performance.md: "thesis-R" is noise of roughness R; "gaussian-S" has an RMS
/// slope S along each axis, so alpha = sqrt(2) S, and a correlation length of 8 cells.
const std::vector<std::string>& surface_names();

/// The settings a name stands for, N = `size`.
SurfaceSettings surface_settings(const std::string& name, int size);

/// True for those whose cells stand together: the ones worth growing.
bool is_gaussian(const std::string& name);

}  // namespace asperity::bench
