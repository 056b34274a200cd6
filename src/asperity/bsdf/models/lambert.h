// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>

#include <vector>

namespace asperity {

/// Lambert's perfectly diffuse surface: f = albedo / pi (thesis 4.2.1, the diffuse part).
class LambertBrdf final : public Bsdf {
  public:
    /// One albedo per channel, each in [0, 1]. Throws Error(Usage, "albedo").
    explicit LambertBrdf(std::vector<double> albedo);

    int channels() const override { return static_cast<int>(albedo_.size()); }
    std::string name() const override;
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    void albedo(Vec3 wi, std::span<double> a) const override;
    bool isotropic() const override { return true; }
    bool bilateral() const override { return true; }

  private:
    std::vector<double> albedo_;
};

/// A direction of the upper hemisphere with density cos(theta) / pi, from two numbers in [0, 1):
/// uniform in sin^2(theta) and phi. Never below the horizon.
Vec3 sample_cosine(double u1, double u2);

}  // namespace asperity
