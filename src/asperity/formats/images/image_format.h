// SPDX-License-Identifier: Apache-2.0
// What a format of pictures is. A program of yours can have read_image know one more:
// ImageReadSettings::formats.
#pragma once

#include <asperity/formats/read_file.h>
#include <asperity/render/image.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// One row of the list of formats.
struct ImageFormat {
    std::string name;                  ///< in messages: "OpenEXR"
    std::vector<std::string> endings;  ///< small letters with the dot: ".exr"
    /// Whether a file that starts like this is one. Throws nothing.
    std::function<bool(const FileStart&)> sniff;
    /// Compares every claimed size with the bytes present before it allocates. Throws as
    /// read_image.
    std::function<Image(const std::string& path)> read;
};

/// The formats that read_image knows by itself. Of two that find a file theirs the first has it.
std::span<const ImageFormat> image_formats();

}  // namespace asperity::io
