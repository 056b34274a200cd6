// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

#include <string>

namespace asperity::io {

/// Makes or reads the surface the settings describe, files included (kind File), tiled as they say.
/// Throws what make_surface throws, and Error(InputOutput | InvalidInput, "file:place").
Heightfield load_surface(const SurfaceSettings& settings, Run& run);

/// Reads heights as they stand in a file, by its ending: .gsf, .exr (one channel), .png (16-bit
/// grey, value / 65535), .txt .csv .asc .dat (matrix). Nothing is scaled or mirrored. The result is
/// marked Finite unless the file, a .gsf of ours, says otherwise.
Heightfield read_heights(const std::string& path);

/// Writes heights by the ending of `path`: .gsf, .exr, .txt. Written to a temporary name, synced,
/// renamed. .gsf keeps diagonal, boundary, unit and the isotropy flag as free header keys.
void write_heights(const Heightfield& surface, const std::string& path);

}  // namespace asperity::io
