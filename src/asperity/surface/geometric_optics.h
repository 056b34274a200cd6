// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <string>

namespace asperity {

/// What speaks for and against following rays over a surface in light of one wavelength.
struct GeometricOptics {
    double wavelength = 0;  ///< [m]
    /// Share of the projected area whose smaller radius of curvature is below 5 wavelengths; rays
    /// are known to fail there (the tangent plane approximation).
    double sharp_share = 0;
    double rms_height = 0;  ///< over the wavelength, Sq / lambda
    /// Share of the reflected light that stays in the mirror direction by interference, at normal
    /// incidence: exp(-(4 pi Sq / lambda)^2), for Gaussian heights. Rays know no such light.
    double coherent_share = 0;
    double spacing = 0;  ///< larger distance of samples over the wavelength
    /// RMS gradient over twice the spacing, over that at the spacing: near 1 where the slopes are
    /// resolved, about 0.7 or below where finer samples would find steeper ones.
    double slope_ratio = 1;

    bool holds = false;
    std::string verdict;  ///< one sentence
};

inline constexpr double kSharpShare = 0.05, kCoherentShare = 0.05, kSlopeRatio = 0.85;

/// Needs a surface in metres. Cost: a pass over the samples. Same value for any number of threads;
/// throws Error(Stopped).
GeometricOptics geometric_optics(const Heightfield& surface, double wavelength, const Run& run);

}  // namespace asperity
