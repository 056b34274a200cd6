// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace asperity {

// The reflectances of fresnel.h for many angles, f[k] for cos_theta[k] in [0, 1], in the precision
// of the angles.
void schlick_lanes(std::span<const float> cos_theta, float f0, float* f);
void dielectric_lanes(std::span<const float> cos_theta, float eta, float* f);        ///< eta != 1
void conductor_lanes(std::span<const float> cos_theta, float n, float k, float* f);  ///< k > 0

void conductor_lanes(std::span<const double> cos_theta, double n, double k, double* f);  ///< k > 0

}  // namespace asperity
