// SPDX-License-Identifier: Apache-2.0
// Surfaces that are a profile along x plus a profile along y; what the shapes share.
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_kinds.h>

#include <functional>

namespace asperity::generators {

/// Height at sample i, in units of dx; `step` is the distance between samples along the profile.
using Profile = std::function<double(int i, double step)>;

/// The profile along x, or along y with settings.along_y. Writes heights of nx x ny samples;
/// advances `run` by ny; throws Error(Stopped).
void fill_one_way(Heightfield& surface, const SurfaceSettings& settings, const Profile& profile,
                  Run& run);

/// The same profile along x and along y, added up.
void fill_both_ways(Heightfield& surface, const Profile& profile, Run& run);

/// tan of the tilt.
double slope_of_tilt(const SurfaceSettings& settings);

/// Samples from the nearest valley of a shape with valleys at 0, period, ...
int to_valley(int i, int period);

// Throw Error(Usage, "period").
void check_period(const SurfaceSettings& settings);       ///< divides the size
void check_even_period(const SurfaceSettings& settings);  ///< and ridges lie on samples
void check_wave(const SurfaceSettings& settings);         ///< and a wave has at least 4 cells

}  // namespace asperity::generators
