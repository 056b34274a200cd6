// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/builtin_models.h>

namespace asperity {

// Each stands in the file of its name.
BsdfModel lambert_model();
BsdfModel cook_torrance_model();
BsdfModel ggx_model();
BsdfModel beckmann_model();
BsdfModel student_t_model();

std::vector<BsdfModel> builtin_bsdf_models() {
    return {
        lambert_model(), cook_torrance_model(), ggx_model(), beckmann_model(), student_t_model(),
    };
}

}  // namespace asperity
