// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/io/read_file.h>

namespace asperity::io {

/// What an OpenEXR file is read for: each has its own limits and words.
enum class ExrContent {
    Heights,  ///< sides as check_sides has them
    Picture,  ///< sides and pixels as in image_reader.h
};

/// Walks through the header of an OpenEXR file before the library sees it: the library allocates
/// what a header claims. Every size must fit the file, the data window our limits, the image the
/// compression that is possible at all. Throws Error(InvalidInput, path), with the offset.
/// Refuses files of several parts and deep images, which hold neither.
void check_exr_outline(const InputFile& file, ExrContent content);

}  // namespace asperity::io
