// SPDX-License-Identifier: Apache-2.0
// What the writer and the reader of RGL files share; inside this folder only.
#pragma once

#include <asperity/formats/bsdfs/bsdf_format.h>

namespace asperity::io {

bool looks_like_rgl(std::string_view head);
std::unique_ptr<Bsdf> read_rgl(const std::string& path);

}  // namespace asperity::io
