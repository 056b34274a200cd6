// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/rgb.h>

namespace asperity {

/// A colour as CIE luminance [kcd/m^2] and chromaticity.
struct SkyColour {
    double luminance = 0, x = 0, y = 0;
};

/// A quantity of a clear sky relative to the zenith, after Perez et al. 1993: a gradient from
/// zenith to horizon times a glow about the sun.
struct PerezTerms {
    double a = 0, b = 0, c = 0, d = 0, e = 0;

    double gradient(double cos_theta) const;
    double glow(double gamma, double cos_gamma) const;
};

/// The sky of Preetham, Shirley and Smits 1999, appendix A2, as seen from the ground.
///
/// Fitted for turbidities of 2 to 10. Near the horizon and for a low sun some colours lie outside
/// sRGB: radiance() makes them paler (see rgb_of_xyz).
class PerezSky {
  public:
    /// `sun_theta`: angle of the sun from the zenith [rad], 0 .. pi/2.
    PerezSky(double sun_theta, double turbidity);

    SkyColour zenith() const { return zenith_; }

    /// Towards a direction, by the cosines of its angles from the zenith, >= 0, and from the sun.
    SkyColour colour(double cos_theta, double cos_gamma) const;
    /// The same in linear sRGB, its luminance in kcd/m^2.
    Rgb radiance(double cos_theta, double cos_gamma) const;

  private:
    PerezTerms luminance_, x_, y_;
    SkyColour zenith_;
    SkyColour scale_;  ///< zenith over the terms' value there
};

}  // namespace asperity
