// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/render/colour.h>
#include <asperity/render/perez_sky.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

// Coefficients of Preetham, Shirley and Smits 1999, appendix A2.

PerezTerms luminance_terms(double turbidity) {
    return {0.1787 * turbidity - 1.4630, -0.3554 * turbidity + 0.4275, -0.0227 * turbidity + 5.3251,
            0.1206 * turbidity - 2.5771, -0.0670 * turbidity + 0.3703};
}

PerezTerms x_terms(double turbidity) {
    return {-0.0193 * turbidity - 0.2592, -0.0665 * turbidity + 0.0008,
            -0.0004 * turbidity + 0.2125, -0.0641 * turbidity - 0.8989,
            -0.0033 * turbidity + 0.0452};
}

PerezTerms y_terms(double turbidity) {
    return {-0.0167 * turbidity - 0.2608, -0.0950 * turbidity + 0.0092,
            -0.0079 * turbidity + 0.2102, -0.0441 * turbidity - 1.6537,
            -0.0109 * turbidity + 0.0529};
}

/// c0 t^3 + c1 t^2 + c2 t + c3
double cubic(double c0, double c1, double c2, double c3, double t) {
    return ((c0 * t + c1) * t + c2) * t + c3;
}

SkyColour zenith_colour(double t, double turbidity) {
    const double chi = (4.0 / 9.0 - turbidity / 120.0) * (kPi - 2 * t);
    const double luminance =
        (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
    const double x = (cubic(0.00166, -0.00375, 0.00209, 0, t) * turbidity +
                      cubic(-0.02903, 0.06377, -0.03202, 0.00394, t)) *
                         turbidity +
                     cubic(0.11693, -0.21196, 0.06052, 0.25886, t);
    const double y = (cubic(0.00275, -0.00610, 0.00317, 0, t) * turbidity +
                      cubic(-0.04214, 0.08970, -0.04153, 0.00516, t)) *
                         turbidity +
                     cubic(0.15346, -0.26756, 0.06670, 0.26688, t);
    return {luminance, x, y};
}

}  // namespace

double PerezTerms::gradient(double cos_theta) const {
    // b < 0: at the horizon exp(-infinity), as it shall be
    return 1 + a * std::exp(b / std::max(cos_theta, 0.0));
}

double PerezTerms::glow(double gamma, double cos_gamma) const {
    return 1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma;
}

PerezSky::PerezSky(double sun_theta, double turbidity)
    : luminance_(luminance_terms(turbidity)),
      x_(x_terms(turbidity)),
      y_(y_terms(turbidity)),
      zenith_(zenith_colour(sun_theta, turbidity)) {
    const auto at_zenith = [&](const PerezTerms& terms) {
        return terms.gradient(1) * terms.glow(sun_theta, std::cos(sun_theta));
    };
    scale_ = {zenith_.luminance / at_zenith(luminance_), zenith_.x / at_zenith(x_),
              zenith_.y / at_zenith(y_)};
}

SkyColour PerezSky::colour(double cos_theta, double cos_gamma) const {
    const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
    return {scale_.luminance * luminance_.gradient(cos_theta) * luminance_.glow(gamma, cos_gamma),
            scale_.x * x_.gradient(cos_theta) * x_.glow(gamma, cos_gamma),
            scale_.y * y_.gradient(cos_theta) * y_.glow(gamma, cos_gamma)};
}

Rgb PerezSky::radiance(double cos_theta, double cos_gamma) const {
    const SkyColour c = colour(cos_theta, cos_gamma);
    const double sum = c.luminance / c.y;  // X + Y + Z
    return rgb_of_xyz(sum * c.x, c.luminance, sum * (1 - c.x - c.y));
}

}  // namespace asperity
