// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>
#include <asperity/surface/preparation.h>

namespace asperity {

/// The settings of what is done to a measured surface, in the order in which it is done.
ParamTable<Preparation> preparation_params();

}  // namespace asperity
