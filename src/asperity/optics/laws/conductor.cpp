// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/fresnel_lanes.h>
#include <asperity/optics/laws/law_checks.h>
#include <asperity/optics/materials.h>
#include <asperity/optics/scattering_law.h>

#include <algorithm>
#include <cmath>

namespace asperity {

double fresnel_conductor(double cos_theta, double n, double k) {
    if (k == 0) return fresnel_dielectric(cos_theta, n);
    const double c = std::clamp(cos_theta, 0.0, 1.0);
    const double s2 = (1 - c) * (1 + c);
    // a + i b = sqrt((n + i k)^2 - sin^2), the branch free of cancellation.
    const double re = (n - k) * (n + k) - s2, im = 2 * n * k;
    const double modulus = std::sqrt(re * re + im * im);
    double a = 0, b = 0;
    if (re >= 0) {
        a = std::sqrt(0.5 * (modulus + re));
        b = 0.5 * im / a;
    } else {
        b = std::sqrt(0.5 * (modulus - re));
        a = 0.5 * im / b;
    }
    // Reflectances of both polarisations (Born and Wolf, 14.2; p over s as a ratio).
    const double b2 = b * b;
    const double rs = ((a - c) * (a - c) + b2) / ((a + c) * (a + c) + b2);
    const double p_minus = a * c - s2, p_plus = a * c + s2, bc2 = b2 * c * c;
    const double rp = rs * (p_minus * p_minus + bc2) / (p_plus * p_plus + bc2);
    return 0.5 * (rs + rp);
}

namespace {

void require_distinct(const std::vector<double>& wavelengths) {
    for (std::size_t a = 0; a < wavelengths.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (wavelengths[a] == wavelengths[b])
                detail::reject("wavelengths", fmt::format("{} nm is given twice", wavelengths[a]));
}

std::vector<ComplexIndex> indices_of_material(const OpticsSettings& s) {
    detail::require_absent("a material, which brings its own", {{"ior", s.ior}, {"k", s.k}});
    const std::vector<double> wavelengths = wavelengths_of(s);
    detail::require_range({"wavelengths", wavelengths}, kMinWavelength, kMaxWavelength, true,
                          "within 400 .. 700 nm");
    require_distinct(wavelengths);
    std::vector<ComplexIndex> indices;
    for (const double w : wavelengths) indices.push_back(refractive_index(s.material, w));
    return indices;
}

std::vector<ComplexIndex> given_indices(const OpticsSettings& s) {
    detail::require_absent("fresnel conductor unless a material is named",
                           {{"wavelengths", s.wavelengths}});
    if (s.ior.empty()) detail::reject("ior", "fresnel conductor needs a material, or ior and k");
    if (s.k.empty()) detail::reject("k", "fresnel conductor needs a material, or ior and k");
    detail::require_ior(s);
    detail::require_range({"k", s.k}, 0, detail::kMaxIndex, true, "within 0 .. 1000");
    const std::size_t count = std::max(s.ior.size(), s.k.size());
    if ((s.ior.size() != 1 && s.ior.size() != count) || (s.k.size() != 1 && s.k.size() != count))
        detail::reject("k", fmt::format("has {} values, ior has {}", s.k.size(), s.ior.size()));
    std::vector<ComplexIndex> indices;
    for (std::size_t c = 0; c < count; ++c)
        indices.push_back({detail::value_of(s.ior, c), detail::value_of(s.k, c)});
    return indices;
}

std::vector<FacetChannel> conductor_channels(const OpticsSettings& s) {
    detail::require_absent("fresnel conductor", {{"f0", s.f0}});
    std::vector<FacetChannel> channels;
    for (const ComplexIndex& index : s.material.empty() ? given_indices(s) : indices_of_material(s))
        channels.push_back({fresnel_conductor(1, index.n, index.k), index.n, index.k});
    return channels;
}

}  // namespace

ScatteringLaw conductor_law() {
    return {FresnelKind::Conductor,
            "conductor",
            "Metal, index",
            "Fresnel's equations for unpolarised light and the complex index of a metal",
            conductor_channels,
            [](double cos_theta, const FacetChannel& c) {
                return fresnel_conductor(cos_theta, c.n, c.k);
            },
            [](std::span<const float> cos_theta, const FacetChannel& c, float* f) {
                const auto n = static_cast<float>(c.n), k = static_cast<float>(c.k);
                if (k > 0)
                    conductor_lanes(cos_theta, n, k, f);
                else if (n == 1)
                    std::fill_n(f, cos_theta.size(), 0.0f);  // no border at all, also along it
                else
                    dielectric_lanes(cos_theta, n, f);
            },
            [](std::span<const double> cos_theta, const FacetChannel& c, double* f) {
                if (c.k > 0) return conductor_lanes(cos_theta, c.n, c.k, f);
                for (std::size_t k = 0; k < cos_theta.size(); ++k)
                    f[k] = fresnel_dielectric(cos_theta[k], c.n);
            }};
}

}  // namespace asperity
