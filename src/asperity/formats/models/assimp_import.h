// SPDX-License-Identifier: Apache-2.0
// The way to assimp, for formats whose readers of ours end at an outline.
#pragma once

#include <asperity/formats/models/model_formats.h>

#include <string>
#include <utility>
#include <vector>

namespace asperity::io::detail {

/// A file that lives in memory, by its name.
using MemoryFile = std::pair<std::string, std::string>;

/// Has assimp read files.front(). It sees the files given and none on disk, so whatever it is led
/// to open has been checked. `path` is for errors. Throws Error(InvalidInput, path) with what
/// assimp says.
Model import_with_assimp(const std::vector<MemoryFile>& files, const std::string& path);

}  // namespace asperity::io::detail
