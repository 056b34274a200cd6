// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

namespace asperity {

/// Makes the surface the settings describe; every kind but kSurfaceFile (io::load_surface does
/// all).
///
/// Same settings, same bits, for any number of threads. Throws Error(Usage, "name of the setting")
/// for values outside their range, Error(OutOfMemory), Error(Stopped) when run.stop_requested().
Heightfield make_surface(const SurfaceSettings& settings, Run& run);

}  // namespace asperity
