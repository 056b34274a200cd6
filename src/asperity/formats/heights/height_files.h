// SPDX-License-Identifier: Apache-2.0
// Readers and writers of formats that hold floats and nothing else; builtin_heights.h has them all.
//
// Readers give the samples as they stand, Boundary::Finite unless the file says otherwise, and
// compare every claimed size with the bytes present before they allocate. They throw
// Error(InvalidInput, "path" or "path:line"), Error(InputOutput, path) and Error(Stopped, path);
// writers Error(InputOutput, path), and leave nothing behind when they fail.
#pragma once

#include <asperity/formats/heights/heights_source.h>
#include <asperity/surface/heightfield.h>

#include <string>

namespace asperity::io {

/// Gwyddion Simple Field 1.0: a text header, 1 to 4 NUL bytes up to a multiple of 4, 32-bit floats.
/// The spacing is XReal / XRes and YReal / YRes (1 for a size that is not given, as the format has
/// it). Units of length with a prefix (nm, um, mm, ...) become m; no unit at all becomes "cell".
Topography read_gsf(const HeightsSource& source);
/// Free keys AsperityDiagonal, AsperityBoundary, AsperityIsotropic, AsperityCellX and
/// AsperityCellY keep what the format has no word for: reading gives the very same surface.
/// AsperitySource and AsperityPrepared tell where it came from and what was done to it.
void write_gsf(const Heightfield& surface, const std::string& path);

/// The one channel of an OpenEXR image, half or float, scan lines or tiles. Spacing 1 cell.
Heightfield read_exr_heights(const HeightsSource& source);
/// One channel "Y" of 32-bit floats, ZIP. Keeps the heights alone.
void write_exr_heights(const Heightfield& surface, const std::string& path);

/// Grey PNG of 16 or 8 bits: heights value / 65535 or value / 255. Spacing 1 cell.
Heightfield read_png_heights(const HeightsSource& source);

/// Rows of the shortest decimals that read back to the same bits. Keeps the heights alone.
void write_text_matrix(const Heightfield& surface, const std::string& path);

/// A patch of nx x ny samples of spacing 1 cell named after the file, its heights still 0.
/// Throws Error(InvalidInput, path) for sides below 2 or above kMaxSurfaceSide.
Heightfield empty_patch(std::uint64_t nx, std::uint64_t ny, const std::string& path);

}  // namespace asperity::io
