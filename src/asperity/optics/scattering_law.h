// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>

#include <span>
#include <string>
#include <vector>

namespace asperity {

/// What a law of reflection needs to know of one channel.
struct FacetChannel {
    double f0 = 1;        ///< reflectance along the normal
    double n = 1, k = 0;  ///< index n + i k against the outside
};

/// How a facet scatters light: a row of scattering_laws().
struct ScatteringLaw {
    FresnelKind kind =
        FresnelKind::None;   ///< in settings; add_scattering_law() gives one of its own
    std::string name = {};   ///< in texts: "schlick"
    std::string label = {};  ///< in lists and forms
    std::string doc = {};    ///< one sentence, without a capital and without its full stop

    /// The channels of these settings. Throws Error(Usage, "name of the setting") for values
    /// outside their range, lists of unequal length, missing or superfluous settings.
    std::vector<FacetChannel> (*channels)(const OpticsSettings&) = nullptr;
    /// Share of unpolarised light that is reflected; cos_theta in [0, 1] between wi and wm.
    double (*reflectance)(double cos_theta, const FacetChannel&) = nullptr;
    /// The same for many angles, in single precision: f[k] for cos_theta[k]. Null: made from
    /// `reflectance`, one after the other.
    void (*reflectances)(std::span<const float> cos_theta, const FacetChannel&, float* f) = nullptr;
    /// The same in double precision, up to rounding. Null: made from `reflectance`, too.
    void (*precise_reflectances)(std::span<const double> cos_theta, const FacetChannel&,
                                 double* f) = nullptr;
};

/// All laws, those of programs that use the library included, in the order of lists. A new one of
/// the library is a file in laws/, a row in scattering_law.cpp and a FresnelKind.
std::vector<ScatteringLaw> scattering_laws();

/// Throws Error(Usage, "fresnel") when there is none of this kind.
const ScatteringLaw& scattering_law(FresnelKind kind);

/// Adds a law: from then on settings may name it, on every engine, and OpticsSettings::fresnel may
/// be the kind that is returned. Kinds are numbered as they are added; results hold the name. Call
/// it before other threads use laws, and before models are asked for. Throws Error(Usage, law.name)
/// when the name is empty or taken, or without `channels` or `reflectance`.
FresnelKind add_scattering_law(ScatteringLaw law);

}  // namespace asperity
