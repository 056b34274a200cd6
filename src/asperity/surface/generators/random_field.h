// SPDX-License-Identifier: Apache-2.0
// What the kinds that start from a Gaussian random field share.
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

#include <cstdint>
#include <string>

namespace asperity::generators {

/// Root mean square of the gradient that the alphas ask for.
double asked_rms_gradient(const SurfaceSettings& settings);

/// A Gaussian field by rules 1 to 3 of SurfaceSettings, its expected gradient as asked for.
void fill_random_field(Heightfield& surface, const SurfaceSettings& settings, Run& run);
std::uint64_t random_field_steps(const SurfaceSettings& settings);

/// Throws Error(Usage, "correlation-length") when a length is longer than the tile.
void check_correlation(const SurfaceSettings& settings);

bool random_field_is_isotropic(const SurfaceSettings& settings);
std::string random_field_name(const SurfaceSettings& settings);

}  // namespace asperity::generators
