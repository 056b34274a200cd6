// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/light.h>

#include <memory>
#include <string>

namespace asperity {

/// Light of the sun through clear air on a plane that faces it [klx, as the luminance]: the
/// spectrum outside the air (ASTM G173-03) through the transmittances of Preetham et al. 1999,
/// appendix A1: Rayleigh scattering, aerosols and ozone. What oxygen and water vapour take lies
/// beyond 690 nm, where the eye sees next to nothing, and is left out.
/// `elevation` [rad] 0 .. pi/2.
Rgb sun_irradiance(double elevation, double turbidity);

/// A far disc of `diameter` [rad] about `direction` of even radiance; on a plane that faces it it
/// gives `irradiance`. sample() is uniform in its solid angle.
std::unique_ptr<Light> make_disc_light(Vec3 direction, double diameter, Rgb irradiance,
                                       std::string name);

}  // namespace asperity
