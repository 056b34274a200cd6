// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "task.h"

namespace asperity::bench {

/// Frame time with the simulated BRDF over that with Cook-Torrance.
Task add_frame(CLI::App& program);
/// Rays per second over bare loops of Embree.
Task add_rays(CLI::App& program);
/// Nanoseconds of one evaluation and one sample of each BRDF.
Task add_shade(CLI::App& program);
/// Variance of a sample when light is found by MIS, by lights alone, by the BRDF alone.
Task add_variance(CLI::App& program);

}  // namespace asperity::bench
