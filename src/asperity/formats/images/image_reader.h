// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/images/image_format.h>
#include <asperity/render/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

/// Largest side of a picture read by read_image, and most pixels.
inline constexpr int kMaxImageSide = 32768;
inline constexpr int kMaxImagePixels = 1 << 28;

struct ImageReadSettings {
    std::vector<ImageFormat> formats;  ///< tried before those of image_formats()
};

/// Reads a picture in linear light: OpenEXR (R, G, B, or Y alone; other channels are left out; half
/// or float; one part, not deep) or Radiance RGBE (old and new run lengths, flat, any of the eight
/// orientations, EXPOSURE undone). Known by the first bytes, whatever the ending. Values are as in
/// the file: the caller judges those that are negative or not finite. Row 0 is on top. Of OpenEXR
/// the display window is given: black where the file has no pixels, without those outside of it.
///
/// Throws Error(InvalidInput, "file" or "file:byte") for a file that is cut, damaged, too large or
/// claims more than its bytes can hold; Error(InputOutput, path).
Image read_image(const std::string& path, const ImageReadSettings& settings = {});

/// Throws Error(InvalidInput, path) for a picture without pixels or beyond the limits above.
void check_image_size(std::uint64_t width, std::uint64_t height, const std::string& path);

}  // namespace asperity::io
