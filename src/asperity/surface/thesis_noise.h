// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <cstdint>

namespace asperity {

/// The thesis' surface (section 2.2.2): independent heights, uniform in [0, 10 roughness] units of
/// dx. The height of sample k depends on (seed, k) alone.
///
/// Writes heights of nx x ny samples; advances `run` by ny; throws Error(Stopped).
void fill_thesis_noise(Heightfield& surface, double roughness, std::uint64_t seed, Run& run);

}  // namespace asperity
