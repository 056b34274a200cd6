// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/surface_kinds.h>

namespace asperity::generators {

// One function for each file of this folder.
SurfaceKind thesis();
SurfaceKind gaussian();
SurfaceKind ggx();
SurfaceKind flat();
SurfaceKind tilted();
SurfaceKind vgroove();
SurfaceKind sawtooth();
SurfaceKind pyramids();
SurfaceKind sinusoid();
SurfaceKind eggcrate();
SurfaceKind ridges();

/// The row of the registry, in the order of lists.
inline constexpr SurfaceKind (*kBuiltin[])() = {
    thesis, gaussian, ggx, flat, tilted, vgroove, sawtooth, pyramids, sinusoid, eggcrate, ridges};

}  // namespace asperity::generators
