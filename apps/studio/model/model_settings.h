// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <asperity/bsdf/bsdf_models.h>

#include <string>
#include <string_view>

namespace asperity::studio {

/// What a parameter was set to, or its default, as a specification writes it.
std::string model_setting(const ModelSettings& all, const BsdfModel& model, const BsdfParam& param);

/// Sets it; what is as by default is not kept.
void set_model_setting(ModelSettings& all, const BsdfModel& model, const BsdfParam& param,
                       const std::string& text);

/// "ggx:alpha=0.3,material=Au": the model with what was set, as parse_brdf_spec reads it. What a
/// specification must give is in it even if nobody set it.
std::string model_spec(const ModelSettings& all, const BsdfModel& model);

/// Several models' settings on a line, "ggx:alpha=0.3,masking=separable,lambert:albedo=0.5": a key
/// with a model's name before it begins that model. Values must lie in the ranges of their rows.
std::string to_line(const ModelSettings& all);
/// Throws Error(Usage, key) for models, keys and values that do not exist.
ModelSettings from_line(const std::string& key, std::string_view line);

/// The same as values. Setting throws Error(Usage, name) for a text with a comma, which a
/// specification cannot hold.
ParamValue model_value(const ModelSettings& all, const BsdfModel& model, const BsdfParam& param);
void set_model_value(ModelSettings& all, const BsdfModel& model, const BsdfParam& param,
                     const ParamValue& value);

/// The row of a parameter, for forms; settings of models are what access(settings) refers to.
template <typename Access>
Param<StudioSettings> model_row(Access access, const BsdfModel& model, const BsdfParam& param) {
    return {param.info,
            [=](const StudioSettings& s) { return model_value(access(s), model, param); },
            [=](StudioSettings& s, const ParamValue& value) {
                set_model_value(access(s), model, param, value);
            }};
}

/// The model of that name. Throws Error(Usage, key) with the names there are.
BsdfModel expect_model(const std::string& key, std::string_view name);

}  // namespace asperity::studio
