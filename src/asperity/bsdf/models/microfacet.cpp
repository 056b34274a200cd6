// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <fmt/format.h>

namespace asperity {
namespace {

double checked_alpha(const char* name, double alpha) {
    if (!(alpha >= 1e-4 && alpha <= 100))
        throw Error(ErrorCode::Usage, fmt::format("{} is not within 0.0001 .. 100", alpha), name);
    return alpha;
}

std::string list_setting(const char* key, const std::vector<double>& values) {
    return values.empty() ? "" : fmt::format(",{}={}", key, fmt::join(values, "/"));
}

std::string fresnel_name(FresnelKind kind) {
    switch (kind) {
        case FresnelKind::None:
            return "";
        case FresnelKind::Schlick:
            return ",fresnel=schlick";
        case FresnelKind::Dielectric:
            return ",fresnel=dielectric";
        case FresnelKind::Conductor:
            return ",fresnel=conductor";
    }
    return "";
}

}  // namespace

MicrofacetBrdf::MicrofacetBrdf(const MicrofacetSettings& settings)
    : settings_(settings),
      surface_{settings.distribution, checked_alpha("alpha", settings.alpha_x),
               checked_alpha("alpha_y", settings.alpha_y)},
      fresnel_(settings.optics) {}

std::string MicrofacetBrdf::name() const {
    const OpticsSettings& optics = settings_.optics;
    std::string line =
        fmt::format("{}:alpha={}", surface_.distribution == SlopeFamily::Ggx ? "ggx" : "beckmann",
                    surface_.alpha_x);
    if (!isotropic()) line += fmt::format(",alpha_y={}", surface_.alpha_y);
    if (settings_.masking == Masking::Separable) line += ",masking=separable";
    line += fresnel_name(optics.fresnel);
    line += list_setting("f0", optics.f0) + list_setting("ior", optics.ior) +
            list_setting("k", optics.k);
    if (!optics.material.empty()) line += ",material=" + optics.material;
    return line + list_setting("wavelengths", optics.wavelengths);
}

void MicrofacetBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    if (wi.z <= 0 || wo.z <= 0) {
        for (double& value : f) value = 0;
        return;
    }
    // The half vector; wi . wm = |wi + wo| / 2, an expression that knows no difference between the
    // two directions.
    const Vec3 sum = wi + wo;
    const double sum_length = length(sum);
    const double lambda_i = surface_.lambda(wi), lambda_o = surface_.lambda(wo);
    const double hidden = settings_.masking == Masking::Correlated
                              ? 1 + (lambda_i + lambda_o)
                              : (1 + lambda_i) * (1 + lambda_o);
    const double d = surface_.normal_density((1 / sum_length) * sum);
    fresnel_.eval(std::min(1.0, 0.5 * sum_length), f);
    const double mirror = d / (4 * (wi.z * wo.z) * hidden);
    for (double& value : f) value *= mirror;
}

std::optional<BsdfSample> MicrofacetBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    const Vec3 wo = reflect(wi, surface_.sample_visible_normal(wi, u1, u2));
    const double density = pdf(wi, wo);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{wo, density};
}

double MicrofacetBrdf::pdf(Vec3 wi, Vec3 wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    // Density of the facet normal / (4 wi . wm), the Jacobian of the reflection (Walter et al.
    // 2007, eq. 14); wi . wm cancels.
    const Vec3 wm = normalize(wi + wo);
    return surface_.normal_density(wm) / (4 * wi.z * (1 + surface_.lambda(wi)));
}

}  // namespace asperity
