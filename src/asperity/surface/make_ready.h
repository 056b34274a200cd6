// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/topography.h>

#include <string>

namespace asperity {

/// Takes the steps that `how` asks for, in the order of Preparation, and says each in `prepared`.
/// Afterwards nothing is missing. Throws as prepare() does.
void make_ready(Topography& topography, const Preparation& how, const std::string& where,
                const Run& run);

}  // namespace asperity
