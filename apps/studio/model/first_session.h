// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

namespace asperity::studio {

/// What the program begins with: a Gaussian surface in gold, lit from all azimuths, that two cores
/// measure in a few seconds; its dome and lobe in even colours, a model under a soft sky, beside
/// Cook-Torrance as soon as Compare is chosen. The thesis' own look is StudioSettings{}.
StudioSettings first_session();

}  // namespace asperity::studio
