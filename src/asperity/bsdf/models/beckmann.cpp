// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet_spec.h>

namespace asperity {

BsdfModel beckmann_model() {
    return smith_model(SlopeFamily::Beckmann, "beckmann", "Beckmann",
                       "microfacets with normally distributed slopes (Beckmann)");
}

}  // namespace asperity
