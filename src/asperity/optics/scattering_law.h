// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>

#include <span>
#include <vector>

namespace asperity {

/// What a law of reflection needs to know of one channel.
struct FacetChannel {
    double f0 = 1;        ///< reflectance along the normal
    double n = 1, k = 0;  ///< index n + i k against the outside
};

/// How a facet scatters light: a row of scattering_laws().
struct ScatteringLaw {
    FresnelKind kind;   ///< in settings
    const char* name;   ///< in texts: "schlick"
    const char* label;  ///< in lists and forms
    const char* doc;    ///< one sentence, without a capital and without its full stop

    /// The channels of these settings. Throws Error(Usage, "name of the setting") for values
    /// outside their range, lists of unequal length, missing or superfluous settings.
    std::vector<FacetChannel> (*channels)(const OpticsSettings&);
    /// Share of unpolarised light that is reflected; cos_theta in [0, 1] between wi and wm.
    double (*reflectance)(double cos_theta, const FacetChannel&);
    /// The same for many angles, in single precision: f[k] for cos_theta[k].
    void (*reflectances)(std::span<const float> cos_theta, const FacetChannel&, float* f);
};

/// All laws, in the order of lists. A new one is a file in laws/, a row in scattering_law.cpp and a
/// FresnelKind.
std::span<const ScatteringLaw> scattering_laws();

/// Throws Error(Usage, "fresnel") when there is none of this kind.
const ScatteringLaw& scattering_law(FresnelKind kind);

}  // namespace asperity
