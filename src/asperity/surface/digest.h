// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <string>

namespace asperity {

/// 32 hexadecimal digits over all of a surface that light sees: heights, spacings, diagonal and
/// boundary (XXH3-128). Two surfaces with equal digests reflect alike; names play no part. Cost:
/// one pass over the heights.
std::string digest(const Heightfield& surface);

}  // namespace asperity
