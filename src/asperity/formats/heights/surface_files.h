// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

#include <string>
#include <vector>

namespace asperity::io {

/// Makes or reads the surface the settings describe, files included (kind File), tiled as they say.
/// Throws what make_surface throws, and Error(InputOutput | InvalidInput, "file:place").
Heightfield load_surface(const SurfaceSettings& settings, Run& run);

/// The same from a topography that is there already, in place of the file that the settings name.
Heightfield surface_of(Topography topography, const SurfaceSettings& settings);
/// The two halves of load_surface: the surface of a file as it was measured, made ready as the
/// settings say, and what fills the plane with it. A made surface is whole after the first.
Heightfield load_patch(const SurfaceSettings& settings, Run& run);
/// The first half from what read_topography(settings, run) gave.
Heightfield patch_of(Topography topography, const SurfaceSettings& settings, const Run& run);
Heightfield tiled(Heightfield patch, const SurfaceSettings& settings);

/// Reads a topography as its file has it, by its content, else its ending, else as `options` say;
/// HeightsFormats has the table. Nothing is filled, scaled or mirrored.
Topography read_topography(const std::string& path, const HeightsOptions& options, Run& run);

/// The same by the settings of a surface of kind kSurfaceFile, with the spacing they give. Throws
/// Error(Usage, "surface") without a file.
Topography read_topography(const SurfaceSettings& settings, Run& run);

/// The channels of the file that the settings name, in its order.
std::vector<HeightsChannel> list_channels(const SurfaceSettings& settings, Run& run);

/// The same as a surface to measure, see prepare(). It is Finite unless the file, a .gsf of ours,
/// says otherwise.
Heightfield read_heights(const std::string& path);

/// Writes heights by the ending of `path`: .gsf, .exr, .txt. Written to a temporary name, synced,
/// renamed. .gsf keeps diagonal, boundary, unit and the isotropy flag as free header keys.
void write_heights(const Heightfield& surface, const std::string& path);

}  // namespace asperity::io
