// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "task.h"

namespace asperity::bench {

/// Cost of a path and memory, by the size of the surface.
Task add_growth(CLI::App& program);
/// Several threads over one.
Task add_threads(CLI::App& program);
/// Exact reflectances of a metal over perfect mirrors.
Task add_fresnel(CLI::App& program);
/// Isotropic light over light of one azimuth.
Task add_around(CLI::App& program);
/// Where the time of a whole run goes.
Task add_stages(CLI::App& program);

}  // namespace asperity::bench
