// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ImfIO.h>
#include <asperity/core/run.h>

#include <functional>
#include <string>

namespace asperity::io {

/// Writes an OpenEXR file through `write`, which hands the stream to the library's writers and lets
/// go of them before it returns. The file appears whole or not at all (AtomicFile, and its
/// `until`). Throws Error(InputOutput, path), Error(OutOfMemory, path).
void write_exr(const std::string& path, const std::function<void(Imf::OStream&)>& write,
               const Run* until = nullptr);

}  // namespace asperity::io
