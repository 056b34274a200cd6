// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/pictures/canvas.h>

#include <string>

namespace asperity::io {

/// Writes the canvas as an 8-bit sRGB PNG, whole or not at all (AtomicFile).
/// Throws Error(InputOutput, path).
void write_png(const Canvas& canvas, const std::string& path);

}  // namespace asperity::io
