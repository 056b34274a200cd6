// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/bsdfs/builtin_formats.h>

namespace asperity::io {

// Each stands in the file of its name.
BsdfFormat layers_exr_format();
BsdfFormat layers_csv_format();
BsdfFormat rgl_format();
BsdfFormat merl_format();
BsdfFormat klems_format();
BsdfFormat tensor_tree_format();
BsdfFormat zemax_format();
BsdfFormat speos_brdf_format();
BsdfFormat speos_anisotropic_format();
BsdfFormat lighttools_format();
BsdfFormat csv_format();
BsdfFormat astm_format();
BsdfFormat openmaterial_format();
BsdfFormat materialx_format();

std::vector<BsdfFormat> builtin_formats() {
    return {
        layers_exr_format(),   layers_csv_format(), rgl_format(),
        merl_format(),         klems_format(),      tensor_tree_format(),
        zemax_format(),        speos_brdf_format(), speos_anisotropic_format(),
        lighttools_format(),   csv_format(),        astm_format(),
        openmaterial_format(), materialx_format(),
    };
}

}  // namespace asperity::io
