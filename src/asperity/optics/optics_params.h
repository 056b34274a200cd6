// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>
#include <asperity/params/param.h>

namespace asperity {

/// The settings of the facets. Which go together, Fresnel decides.
ParamTable<OpticsSettings> optics_params();

}  // namespace asperity
