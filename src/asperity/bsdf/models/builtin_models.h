// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf_models.h>

#include <vector>

namespace asperity {

/// The models that Asperity brings: a new one is a file beside this one and a row in
/// builtin_models.cpp.
std::vector<BsdfModel> builtin_bsdf_models();

}  // namespace asperity
