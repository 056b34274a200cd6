// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/optics_params.h>

#include <asperity/optics/materials.h>
#include <asperity/params/fields.h>

namespace asperity {

namespace {

constexpr Names<FresnelKind, 4> kFresnels = {{
    {"none", FresnelKind::None},
    {"schlick", FresnelKind::Schlick},
    {"dielectric", FresnelKind::Dielectric},
    {"conductor", FresnelKind::Conductor},
}};

}  // namespace

ParamTable<OpticsSettings> optics_params() {
    using S = OpticsSettings;
    ParamTable<S> table = {
        field(&S::fresnel, kFresnels,
              {.name = "fresnel",
               .doc = "none (perfect mirrors), schlick, dielectric or conductor",
               .otherwise = "what the options below imply"}),
        field(&S::f0, {.name = "f0",
                       .label = "F0",
                       .metavar = "X[,Y,Z]",
                       .range = kZeroToOne,
                       .absent = "none",
                       .doc = "schlick: reflectance along the normal, one or per channel",
                       .otherwise = "from the index"}),
        field(&S::ior, {.name = "ior",
                        .label = "Refractive Index",
                        .metavar = "N[,...]",
                        .range = {0, 1000, true},
                        .absent = "none",
                        .doc = "index of refraction (its real part), inside against outside"}),
        field(&S::k, {.name = "k",
                      .metavar = "K[,...]",
                      .range = {0, 1000},
                      .absent = "none",
                      .doc = "conductor: imaginary part of the index"}),
        field(&S::material, {.name = "material",
                             .metavar = "NAME",
                             .absent = "none",
                             .doc = "conductor: Al, Ag, Au, Cu, Cr, Fe, Ni or Ti"}),
        field(&S::wavelengths, {.name = "wavelengths",
                                .metavar = "L[,L...]",
                                .unit = "nm",
                                .range = {kMinWavelength, kMaxWavelength},
                                .absent = "none",
                                .doc = "of a material",
                                .otherwise = "650,550,450: red, green, blue"}),
    };
    for (Param<S>& row : table) row.info.group = "Optics";
    return table;
}

}  // namespace asperity
