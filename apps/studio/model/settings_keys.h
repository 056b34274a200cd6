// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <asperity/params/fields.h>

namespace asperity::studio {

/// The settings of the studio beyond those of the experiment, in the order of a session.
const ParamTable<StudioSettings>& studio_params();

/// Those and the experiment's, for forms.
const ParamTable<StudioSettings>& all_params();

}  // namespace asperity::studio
