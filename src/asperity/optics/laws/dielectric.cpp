// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/fresnel_lanes.h>
#include <asperity/optics/laws/law_checks.h>
#include <asperity/optics/scattering_law.h>

#include <algorithm>
#include <cmath>

namespace asperity {

double fresnel_dielectric(double cos_theta, double eta) {
    if (eta == 1) return 0;  // no border at all, also along it
    const double c = std::clamp(cos_theta, 0.0, 1.0);
    // Snell: sin(theta_t) = sin(theta_i) / eta.
    const double sin2_t = (1 - c) * (1 + c) / (eta * eta);
    if (sin2_t >= 1) return 1;  // total internal reflection
    const double ct = std::sqrt(1 - sin2_t);
    // Fresnel's equations for both polarisations (Born and Wolf, 1.5.2).
    const double rs = (c - eta * ct) / (c + eta * ct);
    const double rp = (eta * c - ct) / (eta * c + ct);
    return 0.5 * (rs * rs + rp * rp);
}

namespace {

std::vector<FacetChannel> dielectric_channels(const OpticsSettings& s) {
    detail::require_absent("fresnel dielectric", {{"f0", s.f0}, {"k", s.k}});
    detail::require_no_material("fresnel dielectric", s);
    if (s.ior.empty()) detail::reject("ior", "fresnel dielectric needs ior");
    detail::require_ior(s);
    std::vector<FacetChannel> channels;
    for (const double n : s.ior) channels.push_back({f0_from_indices(1, n), n, 0});
    return channels;
}

}  // namespace

ScatteringLaw dielectric_law() {
    return {
        FresnelKind::Dielectric,
        "dielectric",
        "Dielectric, index",
        "Fresnel's equations for unpolarised light and a real index, that of glass",
        dielectric_channels,
        [](double cos_theta, const FacetChannel& c) { return fresnel_dielectric(cos_theta, c.n); },
        [](std::span<const float> cos_theta, const FacetChannel& c, float* f) {
            const auto n = static_cast<float>(c.n);
            if (n == 1)
                std::fill_n(f, cos_theta.size(), 0.0f);  // no border at all, also along it
            else
                dielectric_lanes(cos_theta, n, f);
        }};
}

}  // namespace asperity
