// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/models/cook_torrance.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/optics/fresnel.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr Range kRoughness = {0.01, 1};  // at 0 D is 0 / 0
constexpr Names<GeometryRemap, 2> kRemaps = {{
    {"direct", GeometryRemap::Direct},
    {"ibl", GeometryRemap::Ibl},
}};
constexpr Names<DiffuseTerm, 3> kDiffuseTerms = {{
    {"on", DiffuseTerm::Coupled},
    {"off", DiffuseTerm::Off},
    {"uncoupled", DiffuseTerm::Uncoupled},
}};

void require(bool holds, const char* setting, double value, const char* words) {
    if (!holds) throw Error(ErrorCode::Usage, fmt::format("{} is not {}", value, words), setting);
}

/// Thesis eq. 3.6, code 3.2.
double geometry_schlick_ggx(double n_dot_v, double k) {
    return n_dot_v / (n_dot_v * (1 - k) + k);
}

}  // namespace

CookTorranceBrdf::CookTorranceBrdf(const CookTorranceSettings& settings) : settings_(settings) {
    const double r = settings.roughness;
    require(r >= 0.01 && r <= 1, "roughness", r, "within 0.01 .. 1");
    require(settings.metallic >= 0 && settings.metallic <= 1, "metallic", settings.metallic,
            "within 0 .. 1");
    for (const double a : settings.albedo) require(a >= 0 && a <= 1, "albedo", a, "within 0 .. 1");
    // Code 3.4: the width of the distribution is the square of the roughness.
    facets_ = {SlopeFamily::Ggx, r * r, r * r};
    k_ = settings.k == GeometryRemap::Direct ? (r + 1) * (r + 1) / 8 : r * r / 2;
    const bool diffuse = settings.diffuse == DiffuseTerm::Uncoupled ||
                         (settings.diffuse == DiffuseTerm::Coupled && settings.metallic < 1);
    specular_share_ = diffuse ? 0.5 : 1.0;
}

std::string CookTorranceBrdf::name() const {
    return fmt::format("cook-torrance:roughness={},metallic={},albedo={},k={},diffuse={}",
                       settings_.roughness, settings_.metallic, fmt::join(settings_.albedo, "/"),
                       name_of(kRemaps, settings_.k), name_of(kDiffuseTerms, settings_.diffuse));
}

void CookTorranceBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    if (wi.z <= 0 || wo.z <= 0) {
        std::fill(f.begin(), f.end(), 0.0);
        return;
    }
    const Vec3 sum = wi + wo;
    const double sum_length = length(sum);
    const double h_dot_v = std::min(1.0, 0.5 * sum_length);  // = h.l

    // Eq. 3.8; with a = a_x = a_y the anisotropic form is the same function.
    const double d = facets_.normal_density((1 / sum_length) * sum);
    // Eq. 3.7.
    const double g = geometry_schlick_ggx(wi.z, k_) * geometry_schlick_ggx(wo.z, k_);
    // Code 4.1 regularises the denominator by 0.0001.
    const double mirror = d * g / (4 * (wi.z * wo.z) + 0.0001);

    for (std::size_t c = 0; c < f.size(); ++c) {
        const double albedo = settings_.albedo[c];
        const double f0 = 0.04 + (albedo - 0.04) * settings_.metallic;
        const double fresnel = fresnel_schlick(h_dot_v, f0);
        double kd = 0;
        if (settings_.diffuse == DiffuseTerm::Coupled)
            kd = (1 - fresnel) * (1 - settings_.metallic);
        else if (settings_.diffuse == DiffuseTerm::Uncoupled)
            kd = 1;
        f[c] = kd * albedo / kPi + mirror * fresnel;
    }
}

std::optional<BsdfSample> CookTorranceBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    Vec3 wo;
    if (u1 < specular_share_)
        wo = reflect(wi, facets_.sample_visible_normal(wi, u1 / specular_share_, u2));
    else
        wo = sample_cosine((u1 - specular_share_) / (1 - specular_share_), u2);
    const double density = pdf(wi, wo);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{wo, density};
}

double CookTorranceBrdf::pdf(Vec3 wi, Vec3 wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    const Vec3 wm = normalize(wi + wo);
    const double specular = facets_.normal_density(wm) / (4 * wi.z * (1 + facets_.lambda(wi)));
    return specular_share_ * specular + (1 - specular_share_) * wo.z / kPi;
}

namespace {

/// Red, green and blue as a list; one value counts for all three.
Param<CookTorranceSettings> albedo_row() {
    using S = CookTorranceSettings;
    ParamInfo info{.name = "albedo",
                   .metavar = "R[/G/B]",
                   .range = kZeroToOne,
                   .doc = "colour of the diffuse part and of a metal's highlight",
                   .most = 3,
                   .type = ParamType::List};
    return {info, [](const S& s) { return std::vector(s.albedo.begin(), s.albedo.end()); },
            [info](S& s, const ParamValue& value) {
                const auto& list = std::get<std::vector<double>>(value);
                if (list.size() != 1 && list.size() != 3)
                    refuse(info, fmt::format("has {} values, 1 or 3 are taken", list.size()));
                for (std::size_t c = 0; c < 3; ++c) s.albedo[c] = list[list.size() == 1 ? 0 : c];
            }};
}

}  // namespace

BsdfModel cook_torrance_model() {
    using S = CookTorranceSettings;
    BsdfModel model = bsdf_model<S>(
        "cook-torrance", "Cook-Torrance",
        "the thesis' model (eq. 4.2 and 4.4): GGX normals, Schlick's shadowing and reflectance",
        {field(&S::roughness, {.name = "roughness",
                               .range = kRoughness,
                               .doc = "alpha = roughness^2 of the distribution of normals (thesis "
                                      "eq. 3.8), and k of the shadowing (eq. 3.6)"}),
         field(&S::metallic, {.name = "metallic",
                              .range = kZeroToOne,
                              .doc = "F0 = 0.04 + (albedo - 0.04) metallic (thesis eq. 3.3); a "
                                     "metal has no diffuse part (eq. 4.4)"}),
         albedo_row(),
         field(
             &S::k, kRemaps,
             {.name = "k",
              .label = "Shadowing",
              .doc = "k of the shadowing: direct, (roughness + 1)^2 / 8, or ibl, roughness^2 / 2"}),
         field(&S::diffuse, kDiffuseTerms,
               {.name = "diffuse",
                .doc = "the diffuse part: on, (1 - F) (1 - metallic); off; or uncoupled, 1"})},
        [](const S& s) { return std::make_unique<CookTorranceBrdf>(s); }, {"roughness"});
    model.with_alpha = [](double alpha) {
        const double roughness = std::clamp(std::sqrt(alpha), kRoughness.low, kRoughness.high);
        return SpecSettings{{"roughness", fmt::format("{}", roughness)}};
    };
    return model;
}

}  // namespace asperity
