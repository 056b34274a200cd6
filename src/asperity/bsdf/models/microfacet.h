// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/smith.h>
#include <asperity/bsdf/smith_lanes.h>
#include <asperity/core/directions.h>
#include <asperity/optics/fresnel.h>

#include <algorithm>
#include <array>
#include <type_traits>

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
        const double d = surface_.normal_density((1 / sum_length) * sum);
        fresnel_.eval(std::min(1.0, 0.5 * sum_length), f);
        const double mirror =
            d / (4 * (wi.z * wo.z) * hidden(surface_.lambda(wi), surface_.lambda(wo)));
        for (double& value : f) value *= mirror;
    }

    /// Lambda of wi is found once, that of wo once for as many as lie at one polar angle.
    void eval_many(Vec3 wi, std::span<const Vec3> wo, std::span<double> f) const override {
        constexpr std::size_t kAtOnce = 64;
        std::array<double, kAtOnce> mirror, cosine, reflectance;
        const std::size_t each = static_cast<std::size_t>(channels());
        const bool round = surface_.alpha_x == surface_.alpha_y;
        const double lambda_i = surface_.lambda(wi);
        double z = 0, lambda_o = 0;
        for (std::size_t begin = 0; begin < wo.size(); begin += kAtOnce) {
            const std::span<const Vec3> part =
                wo.subspan(begin, std::min(kAtOnce, wo.size() - begin));
            find_facets(wi, part, mirror.data(), cosine.data());
            for (std::size_t k = 0; k < part.size(); ++k) {
                const Vec3 w = part[k];
                if (w.z != z || !round) lambda_o = surface_.lambda(w);
                z = w.z;
                if (wi.z <= 0 || w.z <= 0)
                    mirror[k] = cosine[k] = 0;
                else
                    mirror[k] /= 4 * (wi.z * w.z) * hidden(lambda_i, lambda_o);
            }
            for (std::size_t c = 0; c < each; ++c) {
                fresnel_.eval(static_cast<int>(c),
                              std::span<const double>(cosine).first(part.size()),
                              reflectance.data());
                for (std::size_t k = 0; k < part.size(); ++k)
                    f[(begin + k) * each + c] = reflectance[k] * mirror[k];
            }
        }
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
    /// Facets over those that both directions see.
    double hidden(double lambda_i, double lambda_o) const {
        return masking_ == Masking::Correlated ? 1 + (lambda_i + lambda_o)
                                               : (1 + lambda_i) * (1 + lambda_o);
    }

    /// Of the facets that mirror wi to each wo: D, and wi . wm.
    void find_facets(Vec3 wi, std::span<const Vec3> wo, double* density, double* cosine) const {
        if constexpr (std::is_same_v<Facets, SmithSurface>) {
            mirroring_facets(surface_, wi, wo, density, cosine);
        } else {
            for (std::size_t k = 0; k < wo.size(); ++k) {
                const Vec3 sum = wi + wo[k];
                const double sum_length = length(sum);
                density[k] = surface_.normal_density((1 / sum_length) * sum);
                cosine[k] = std::min(1.0, 0.5 * sum_length);
            }
        }
    }

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
