// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/bsdfs/bsdf_format.h>

#include <vector>

namespace asperity::io {

/// The formats that Asperity brings, in the order in which their endings are tried.
std::vector<BsdfFormat> builtin_formats();

}  // namespace asperity::io
