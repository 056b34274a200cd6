// SPDX-License-Identifier: Apache-2.0
#include <asperity/optics/optics_params.h>

#include <asperity/optics/materials.h>
#include <asperity/optics/scattering_law.h>
#include <asperity/params/fields.h>

namespace asperity {

namespace {

/// The choices are the rows of scattering_laws().
Param<OpticsSettings> law_row() {
    using S = OpticsSettings;
    ParamInfo info{.name = "fresnel",
                   .doc = "none (perfect mirrors), schlick, dielectric or conductor",
                   .otherwise = "what the options below imply",
                   .type = ParamType::Choice};
    for (const ScatteringLaw& law : scattering_laws()) info.choices.push_back(law.name);
    return {info, [](const S& s) { return scattering_law(s.fresnel).name; },
            [info](S& s, const ParamValue& value) {
                for (const ScatteringLaw& law : scattering_laws())
                    if (law.name == std::get<std::string>(value)) s.fresnel = law.kind;
            }};
}

/// "Ag, Al, Au, Cr, Cu, Fe, Ni or Ti"
std::string symbols() {
    std::string list;
    for (const TabulatedMaterial& metal : materials()) {
        const bool last = &metal == &materials().back();
        list += (list.empty() ? "" : last ? " or " : ", ") + std::string(metal.symbol);
    }
    return list;
}

}  // namespace

ParamTable<OpticsSettings> optics_params() {
    using S = OpticsSettings;
    ParamTable<S> table = {
        law_row(),
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
                             .doc = "conductor: " + symbols()}),
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
