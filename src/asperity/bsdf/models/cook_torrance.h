// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/smith.h>

#include <array>

namespace asperity {

/// How roughness r becomes the k of Schlick's geometry function (thesis, below code 3.2).
enum class GeometryRemap {
    Direct,  ///< k = (r + 1)^2 / 8, code 3.2: light from a point
    Ibl,     ///< k = r^2 / 2: light from an environment map
};

/// What stands for k_d c / pi of thesis eq. 4.1 and 4.4, c being the albedo. The thesis gives k_d
/// no formula; code 4.1 returns the specular part alone.
enum class DiffuseTerm {
    Off,  ///< k_d = 0: code 4.1 as it stands
    /// k_d = (1 - F) (1 - metallic): what is not mirrored, F at the half vector. Keeps the albedo
    /// below 1 but for up to 5 % at grazing light on a smooth surface.
    Coupled,
    Uncoupled,  ///< k_d = 1: the sum the thesis program shows; may reflect more than it receives
};

struct CookTorranceSettings {
    double roughness = 0.5;  ///< r, 0.01 .. 1 (r = 0 would be a mirror, D = 0 / 0)
    double metallic = 1;     ///< 0 .. 1
    std::array<double, 3> albedo = {1, 1, 1};  ///< red, green, blue, 0 .. 1
    GeometryRemap k = GeometryRemap::Direct;
    DiffuseTerm diffuse = DiffuseTerm::Coupled;
};

/// The thesis' Cook-Torrance model, to the letter (eq. 3.3, 3.6-3.8, 4.1-4.4; code 3.1-3.4, 4.1):
///
///     f = k_d albedo / pi + D G F / (4 (n.v) (n.l) + 0.0001)
///     D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2),  a = r^2 as in code 3.4
///     G = g(n.v) g(n.l),  g(x) = x / (x (1 - k) + k)
///     F = F0 + (1 - F0) (1 - h.v)^5,  F0 = 0.04 + (albedo - 0.04) metallic
///
/// Three channels: red, green, blue. It is reciprocal, and it loses much energy at low roughness
/// and grazing light: that is the model, not an error. sample() draws the half vector from the
/// normals of a GGX surface that wi sees, half of the time instead a cosine when there is a
/// diffuse part.
class CookTorranceBrdf final : public Bsdf {
  public:
    /// Throws Error(Usage, "roughness" | "metallic" | "albedo").
    explicit CookTorranceBrdf(const CookTorranceSettings& settings);

    int channels() const override { return 3; }
    std::string name() const override;
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    bool isotropic() const override { return true; }
    bool bilateral() const override { return true; }
    std::optional<double> normal_density(Vec3 wm) const override {
        return facets_.normal_density(wm);
    }

  private:
    CookTorranceSettings settings_;
    SmithSurface facets_;
    double k_ = 0;
    double specular_share_ = 1;  ///< of the samples
};

}  // namespace asperity
