// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/smith.h>
#include <asperity/optics/fresnel.h>

namespace asperity {

/// How the masking of wi and that of wo go together (Heitz 2014, section 6).
enum class Masking {
    Correlated,  ///< G2 = 1 / (1 + Lambda(wi) + Lambda(wo)), eq. 99: high facets see both well
    Separable,   ///< G2 = G1(wi) G1(wo), eq. 98
};

struct MicrofacetSettings {
    SlopeFamily distribution = SlopeFamily::Ggx;
    double alpha_x = 0.5, alpha_y = 0.5;  ///< 1e-4 .. 100
    Masking masking = Masking::Correlated;
    OpticsSettings optics;  ///< F = 1 unless set
};

/// Single reflection at a rough surface of mirror facets (Cook and Torrance 1982; Walter et al.
/// 2007, eq. 20):
///
///     f = F(wi . wm) D(wm) G2(wi, wo) / (4 cos(theta_i) cos(theta_o)),   wm = half vector.
///
/// Light that meets a second facet is lost, so with F = 1 the albedo is below 1. sample() draws the
/// facet normal from those that wi sees: pdf = G1(wi) D(wm) / (4 cos(theta_i)); samples mirrored
/// below the horizon give none.
class MicrofacetBrdf final : public Bsdf {
  public:
    /// Throws Error(Usage) naming "alpha", "alpha_y" or what Fresnel names.
    explicit MicrofacetBrdf(const MicrofacetSettings& settings);

    const SmithSurface& surface() const { return surface_; }

    int channels() const override { return fresnel_.channels(); }
    std::string name() const override;
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    bool isotropic() const override { return surface_.alpha_x == surface_.alpha_y; }

  private:
    MicrofacetSettings settings_;
    SmithSurface surface_;
    Fresnel fresnel_;
};

}  // namespace asperity
