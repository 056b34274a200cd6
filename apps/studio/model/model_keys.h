// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <asperity/params/param.h>

#include <string>

namespace asperity::studio {

/// Which model a BRDF of the view is, and its parameters: "brdf-type" and more of that prefix.
/// Metallic, roughness and albedo of Cook-Torrance have keys of their own, those of other models
/// stand together in one.
ParamTable<StudioSettings> brdf_model_keys(const char* heading, const std::string& prefix,
                                           BrdfSettings ModelView::*side);

/// Which models are drawn beside a measurement, and their parameters. Cook-Torrance, GGX and
/// Beckmann have keys of their own, other models stand together.
ParamTable<StudioSettings> overlay_keys(const char* heading);

}  // namespace asperity::studio
