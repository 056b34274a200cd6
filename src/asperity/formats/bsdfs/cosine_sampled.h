// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/bsdf/models/lambert.h>

namespace asperity::io {

/// A Bsdf from a file that brings no density of its own: sampled from a cosine. Correct for any f,
/// noisy for sharp lobes; bake_brdf gives a better density for pictures.
class CosineSampledBsdf : public Bsdf {
  public:
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return cosine_.sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return cosine_.pdf(wi, wo); }

  private:
    LambertBrdf cosine_{std::vector<double>{1.0}};
};

}  // namespace asperity::io
