// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>

#include <memory>
#include <string>

namespace asperity {

/// Makes an analytic BRDF from one line, "model:key=value,key=value", such as
///
///     lambert:albedo=0.5/0.4/0.3
///     ggx:alpha=0.3,material=Au
///
/// Models and their keys are the rows of bsdf_models(); lists have "/" between their numbers.
/// Throws Error(Usage, spec) naming what is wrong and the models or keys there are.
std::unique_ptr<Bsdf> parse_brdf_spec(const std::string& spec);

/// True when `spec` begins with the name of an analytic model.
bool is_brdf_spec(const std::string& spec);

/// The form of all models' specifications, for help: indented lines, each with its line end.
std::string brdf_spec_help();

}  // namespace asperity
