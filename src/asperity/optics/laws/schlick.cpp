// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/fresnel_lanes.h>
#include <asperity/optics/laws/law_checks.h>
#include <asperity/optics/scattering_law.h>

#include <algorithm>

namespace asperity {

double fresnel_schlick(double cos_theta, double f0) {
    const double m = std::clamp(1.0 - cos_theta, 0.0, 1.0);
    const double m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}

double f0_from_indices(double n1, double n2) {
    const double r = (n1 - n2) / (n1 + n2);
    return r * r;
}

namespace {

std::vector<FacetChannel> schlick_channels(const OpticsSettings& s) {
    detail::require_absent("fresnel schlick", {{"k", s.k}});
    detail::require_no_material("fresnel schlick", s);
    if (s.f0.empty() == s.ior.empty())
        detail::reject(
            "f0", s.f0.empty() ? "fresnel schlick needs f0 or ior" : "give f0 or ior, not both");
    detail::require_f0(s);
    detail::require_ior(s);
    std::vector<FacetChannel> channels;
    for (const double f0 : s.f0) channels.push_back({f0, 1, 0});
    // Thesis eq. 3.5 against air, n1 = 1.
    for (const double n : s.ior) channels.push_back({f0_from_indices(1, n), n, 0});
    return channels;
}

}  // namespace

ScatteringLaw schlick_law() {
    return {
        FresnelKind::Schlick,
        "schlick",
        "Schlick, F0",
        "Schlick's approximation (thesis eq. 3.3) from the reflectance along the normal",
        schlick_channels,
        [](double cos_theta, const FacetChannel& c) { return fresnel_schlick(cos_theta, c.f0); },
        [](std::span<const float> cos_theta, const FacetChannel& c, float* f) {
            schlick_lanes(cos_theta, static_cast<float>(c.f0), f);
        }};
}

}  // namespace asperity
