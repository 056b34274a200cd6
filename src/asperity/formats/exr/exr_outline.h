// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/read_file.h>

#include <cstdint>
#include <string>

namespace asperity::io {

/// What an OpenEXR file is read for, in the words of its messages.
enum class ExrContent { Heights, Picture };

/// Throws when an image of so many columns and rows is too large for the caller.
using SizeCheck = void (*)(std::uint64_t nx, std::uint64_t ny, const std::string& path);

/// Walks through the header of an OpenEXR file before the library sees it: the library allocates
/// what a header claims. Every size must fit the file, the data window what `check_size` allows,
/// the image the compression that is possible at all. Throws Error(InvalidInput, path), with the
/// offset. Refuses files of several parts and deep images, which hold neither.
void check_exr_outline(const InputFile& file, ExrContent content, SizeCheck check_size);

}  // namespace asperity::io
