// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/image.h>

#include <cstdint>
#include <string>

namespace asperity::io {

/// Largest side of a picture read by read_image, and most pixels.
inline constexpr int kMaxImageSide = 32768;
inline constexpr int kMaxImagePixels = 1 << 28;

/// Reads a picture in linear light: .exr (R, G, B, or Y alone; other channels are left out; half
/// or float; one part, not deep) or .hdr (Radiance RGBE, old and new run lengths, flat, any of the
/// eight orientations, EXPOSURE undone). Known by the first bytes. Values are as in the file: the
/// caller judges those that are negative or not finite. Row 0 is on top.
///
/// Throws Error(InvalidInput, "file" or "file:byte") for a file that is cut, damaged, too large or
/// claims more than its bytes can hold; Error(InputOutput, path).
Image read_image(const std::string& path);

/// Throws Error(InvalidInput, path) for a picture without pixels or beyond the limits above.
void check_image_size(std::uint64_t width, std::uint64_t height, const std::string& path);

}  // namespace asperity::io
