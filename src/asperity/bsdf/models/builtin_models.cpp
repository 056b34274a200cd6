// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/builtin_models.h>
#include <asperity/bsdf/models/plus_lambert.h>

namespace asperity {

// Each stands in the file of its name.
BsdfModel lambert_model();
BsdfModel cook_torrance_model();
BsdfModel ggx_model();
BsdfModel beckmann_model();
BsdfModel student_t_model();
BsdfModel abg_model();

std::vector<BsdfModel> builtin_bsdf_models() {
    return {
        lambert_model(),
        plus_lambert(cook_torrance_model()),
        plus_lambert(ggx_model()),
        plus_lambert(beckmann_model()),
        plus_lambert(student_t_model()),
        plus_lambert(abg_model()),
    };
}

}  // namespace asperity
