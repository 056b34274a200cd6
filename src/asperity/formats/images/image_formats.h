// SPDX-License-Identifier: Apache-2.0
// One reader per format of pictures in linear light; read_image chooses between them.
//
// Readers compare every claimed size with the bytes present before they allocate. They throw
// Error(InvalidInput, "path" or "path:byte") and Error(InputOutput, path).
#pragma once

#include <asperity/render/image.h>

#include <string>

namespace asperity::io {

/// OpenEXR: R, G and B, or Y alone, in half or float.
Image read_exr_image(const std::string& path);

/// Radiance RGBE: old and new run lengths or flat, the exposure undone.
Image read_hdr_image(const std::string& path);

}  // namespace asperity::io
