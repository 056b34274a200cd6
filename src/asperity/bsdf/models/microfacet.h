// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/smith.h>
#include <asperity/core/directions.h>
#include <asperity/optics/fresnel.h>

#include <algorithm>

namespace asperity {

/// How the masking of wi and that of wo go together (Heitz 2014, section 6).
enum class Masking {
    Correlated,  ///< G2 = 1 / (1 + Lambda(wi) + Lambda(wo)), eq. 99: high facets see both well
    Separable,   ///< G2 = G1(wi) G1(wo), eq. 98
};

/// Single reflection at a rough surface of mirror facets (Cook and Torrance 1982; Walter et al.
/// 2007, eq. 20):
///
///     f = F(wi . wm) D(wm) G2(wi, wo) / (4 cos(theta_i) cos(theta_o)),   wm = half vector.
///
/// Light that meets a second facet is lost, so with F = 1 the albedo is below 1. sample() draws the
/// facet normal from those that wi sees: pdf = G1(wi) D(wm) / (4 cos(theta_i)); samples mirrored
/// below the horizon give none.
///
/// Facets is a distribution of facets in Smith's sense with the members that SmithSurface has:
/// alpha_x, alpha_y, normal_density, lambda, sample_visible_normal.
template <class Facets>
class MicrofacetModel : public Bsdf {
  public:
    /// `name`: the specification. Throws Error(Usage) naming what Fresnel names.
    MicrofacetModel(std::string name, const Facets& facets, Masking masking,
                    const OpticsSettings& optics)
        : name_(std::move(name)), surface_(facets), masking_(masking), fresnel_(optics) {}

    const Facets& surface() const { return surface_; }

    int channels() const override { return fresnel_.channels(); }
    std::vector<std::string> channel_names() const override { return fresnel_.channel_names(); }
    std::string name() const override { return name_; }
    bool isotropic() const override { return surface_.alpha_x == surface_.alpha_y; }
    bool bilateral() const override { return true; }
    std::optional<double> normal_density(Vec3 wm) const override {
        return surface_.normal_density(wm);
    }

    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        if (wi.z <= 0 || wo.z <= 0) {
            for (double& value : f) value = 0;
            return;
        }
        // The half vector; wi . wm = |wi + wo| / 2, an expression that knows no difference between
        // the two directions.
        const Vec3 sum = wi + wo;
        const double sum_length = length(sum);
        const double lambda_i = surface_.lambda(wi), lambda_o = surface_.lambda(wo);
        const double hidden = masking_ == Masking::Correlated ? 1 + (lambda_i + lambda_o)
                                                              : (1 + lambda_i) * (1 + lambda_o);
        const double d = surface_.normal_density((1 / sum_length) * sum);
        fresnel_.eval(std::min(1.0, 0.5 * sum_length), f);
        const double mirror = d / (4 * (wi.z * wo.z) * hidden);
        for (double& value : f) value *= mirror;
    }

    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        if (wi.z <= 0) return std::nullopt;
        const Vec3 wo = reflect(wi, surface_.sample_visible_normal(wi, u1, u2));
        const double density = pdf(wi, wo);
        if (!(density > 0)) return std::nullopt;
        return BsdfSample{wo, density};
    }

    double pdf(Vec3 wi, Vec3 wo) const override {
        if (wi.z <= 0 || wo.z <= 0) return 0;
        // Density of the facet normal / (4 wi . wm), the Jacobian of the reflection (Walter et al.
        // 2007, eq. 14); wi . wm cancels.
        const Vec3 wm = normalize(wi + wo);
        return surface_.normal_density(wm) / (4 * wi.z * (1 + surface_.lambda(wi)));
    }

  private:
    std::string name_;
    Facets surface_;
    Masking masking_;
    Fresnel fresnel_;
};

struct MicrofacetSettings {
    SlopeFamily distribution = SlopeFamily::Ggx;
    double alpha_x = 0.5, alpha_y = 0.5;  ///< 1e-4 .. 100
    Masking masking = Masking::Correlated;
    OpticsSettings optics;  ///< F = 1 unless set
};

/// The model with GGX's or Beckmann's facets.
class MicrofacetBrdf final : public MicrofacetModel<SmithSurface> {
  public:
    /// Throws Error(Usage) naming "alpha", "alpha_y" or what Fresnel names.
    explicit MicrofacetBrdf(const MicrofacetSettings& settings);
};

}  // namespace asperity
