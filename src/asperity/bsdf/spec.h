// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>

#include <memory>
#include <string>

namespace asperity {

/// Makes an analytic BRDF from one line, "model:key=value,key=value":
///
///     lambert:albedo=0.5[/0.4/0.3]
///     cook-torrance:roughness=0.4,metallic=1,albedo=1/0.8/0.3,k=direct|ibl
///     ggx:alpha=0.3[,alpha_y=0.1][,masking=correlated|separable][,fresnel...]
///     beckmann:alpha=0.3 ...
///
/// ggx and beckmann take f0=, ior=, k=, material= as the command line does (lists with "/").
/// Throws Error(Usage, spec) naming what is wrong and the keys there are.
std::unique_ptr<Bsdf> parse_brdf_spec(const std::string& spec);

/// True when `spec` begins with the name of an analytic model.
bool is_brdf_spec(const std::string& spec);

}  // namespace asperity
