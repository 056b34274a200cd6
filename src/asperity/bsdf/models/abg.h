// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>

#include <vector>

namespace asperity {

struct AbgSettings {
    std::vector<double> a = {0.0025};  ///< A, one or one per channel [1/sr], 1e-12 .. 1e6
    double b = 0.001;                  ///< B, 1e-12 .. 1e6
    double g = 2;                      ///< 0 .. 10
};

/// The ABg model of optical design programs (ABg scatter of OpticStudio, FRED's Harvey-Shack in the
/// same form), a straight line in a log-log plot beyond its shoulder at B^(1/g):
///
///     f = A / (B + |beta - beta0|^g)  [1/sr],
///
/// beta and beta0 being the projections of the direction looked at and of the mirror direction onto
/// the surface. It depends on their difference alone ("shift-invariant") and, as |beta - beta0| is
/// |wi + wo| along the surface, it is reciprocal and isotropic.
///
/// It describes polished surfaces and is no microfacet model: no facets, no Fresnel factor, no
/// shadowing. Nothing keeps its albedo below 1, which falls towards grazing light as part of the
/// lobe leaves the unit disk; along the normal, with g = 2, it is pi A ln(1 + 1/B).
///
/// sample() draws |beta - beta0| from a table of rings about beta0 and gives none where beta falls
/// outside the unit disk.
class AbgBrdf final : public Bsdf {
  public:
    /// Throws Error(Usage, "a" | "b" | "g").
    explicit AbgBrdf(AbgSettings settings);

    int channels() const override { return static_cast<int>(settings_.a.size()); }
    std::string name() const override;
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    bool isotropic() const override { return true; }
    bool bilateral() const override { return true; }

  private:
    double below(double radius) const;  ///< integral of the table over the disk of this radius

    AbgSettings settings_;
    std::vector<double> radii_;      ///< edges of the rings, from 0 to 2
    std::vector<double> densities_;  ///< of the table in a ring, not normalised
    std::vector<double> sums_;       ///< integral of the table below radii_[k]
};

}  // namespace asperity
