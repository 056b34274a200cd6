// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/binary_view.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Whether a file that begins like this is a compound file of Microsoft's (OLE).
bool is_compound_file(std::string_view head);

/// The bytes of the stream of this name, plain letters, wherever in the file's storages it lies.
/// Short streams, which lie in the file's mini sectors, are not read. Throws
/// Error(InvalidInput, path). Source: Microsoft, [MS-CFB].
std::vector<std::byte> read_compound_stream(const BinaryView& view, std::string_view name);

}  // namespace asperity::io
