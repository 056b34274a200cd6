// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/image.h>
#include <asperity/render/light.h>

#include <memory>
#include <vector>

namespace asperity {

/// A clear sky and its sun after Preetham, Shirley and Smits 1999, "A practical analytic model for
/// daylight": Perez' distribution with their coefficients for the sky, their transmittances of the
/// air for the sun (see sun.h). The fit has its limits: near the horizon and for a low sun some of
/// its colours lie outside sRGB and are made paler at their luminance. A sun that the horizon cuts
/// shines as a whole.
struct SkySettings {
    double sun_elevation_deg = 45;  ///< 0 .. 90
    double sun_azimuth_deg = 45;    ///< from -z towards +x: 0 shines on the model's back
    double turbidity = 3;           ///< 2 (very clear) .. 10 (hazy)
    /// 1: sky and sun together give a white, matt, level plane the luminance 1. > 0
    double scale = 1;
    bool sun = true;  ///< false: the sky alone, as bright as it would be beside its sun
    /// Diameter of the sun, 0.1 .. 20; larger suns give softer shadows, not more light.
    double sun_diameter_deg = 0.533;
    double ground_albedo = 0.2;  ///< of the world below the horizon, 0 .. 1, lit by sky and sun
};

/// The radiance of the sky without its sun as a latitude-longitude map, 2 * height texels wide.
/// height >= 2. Throws Error(Usage, "sun-elevation" | "turbidity" | ...).
Image make_sky_map(const SkySettings& settings, int height = 512);

/// The sky as an environment light, and its sun: a disc of even radiance, drawn uniformly in its
/// solid angle. Throws as make_sky_map.
std::vector<std::unique_ptr<Light>> make_sky(const SkySettings& settings);

}  // namespace asperity
