// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>
#include <asperity/surface/surface_settings.h>

namespace asperity {

/// Every setting of a surface: "surface" itself, those that kinds share, then those that one kind
/// of surface_kinds() has alone.
ParamTable<SurfaceSettings> surface_params();

}  // namespace asperity
