// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet_spec.h>

namespace asperity {

BsdfModel ggx_model() {
    return smith_model(SlopeFamily::Ggx, "ggx", "GGX",
                       "microfacets with the long-tailed slopes of GGX (Walter et al. 2007)");
}

}  // namespace asperity
