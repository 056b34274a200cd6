// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace asperity {

/// How much a facet reflects. Laws that programs add have numbers beyond these, see
/// optics/scattering_law.h.
enum class FresnelKind {
    None,        ///< F = 1: the thesis' perfect mirrors
    Schlick,     ///< thesis eq. 3.3 with F0 per channel, or F0 from `ior` by thesis eq. 3.5
    Dielectric,  ///< exact, unpolarised, real index `ior`
    Conductor,   ///< exact, unpolarised, complex index ior + i k, or a tabulated `material`
};

/// Everything that decides how a facet reflects. One value per channel; a list of one serves all.
struct OpticsSettings {
    FresnelKind fresnel = FresnelKind::None;
    std::vector<double> f0;   ///< Schlick: reflectance along the normal, 0 .. 1
    std::vector<double> ior;  ///< real part of the index against the outside, > 0
    std::vector<double> k;    ///< imaginary part, >= 0
    std::string material;     ///< conductor: "Au", a symbol in materials()
    /// Wavelengths of the channels of a `material` [nm], 400 .. 700. Empty: one each for red, green
    /// and blue, kRgbWavelengths.
    std::vector<double> wavelengths;
};

}  // namespace asperity
