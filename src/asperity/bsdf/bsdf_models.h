// SPDX-License-Identifier: Apache-2.0
// Analytic models of reflection: one row a model, from which specifications are read and lists,
// help and forms are made.
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/params/param.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity {

/// What a specification says: keys and the texts of their values, lists with "/" between numbers.
using SpecSettings = std::vector<std::pair<std::string, std::string>>;

/// A parameter of a model.
struct BsdfParam {
    ParamInfo info;
    std::string otherwise;  ///< its default, as a specification writes it
    bool required = false;  ///< a specification must give it
};

/// An analytic model.
struct BsdfModel {
    std::string name = {};   ///< in small letters and dashes: "cook-torrance"
    std::string label = {};  ///< in lists and forms: "Cook-Torrance"
    std::string doc = {};    ///< one sentence, without a capital and without its full stop
    std::vector<BsdfParam> params = {};

    /// Makes the BSDF; each key is one of `params` and none is there twice. Throws Error(Usage,
    /// key) for a value that is no value of its parameter or that the others do not go with.
    std::function<std::unique_ptr<Bsdf>(const SpecSettings&)> make = {};

    /// The settings that give its facets slopes of the width alpha (1e-3 .. 100), or as near as the
    /// model comes. Not set: it has no such width.
    std::function<SpecSettings(double alpha)> with_alpha = {};
};

/// All models, in the order of lists: those of the library, then those added.
std::vector<BsdfModel> bsdf_models();

/// The model of that name, if there is one.
std::optional<BsdfModel> find_bsdf_model(std::string_view name);

/// "lambert, cook-torrance, ...": all names, for messages and help.
std::string bsdf_model_names();

/// Adds a model, to be known from now on to parse_brdf_spec and to what is made from the list.
/// Call it before other threads use models. Throws Error(Usage, model.name) when the name is empty
/// or taken or holds a character that specifications use, or when `make` is not set.
void add_bsdf_model(BsdfModel model);

/// The text that a row of params/ reads for a value of a specification, and back: in a
/// specification commas part the settings, so its lists have "/".
std::string from_spec_text(const ParamInfo& info, std::string_view text);
std::string to_spec_text(const ParamInfo& info, std::string text);

/// A model whose parameters are the rows of a settings struct. `required`: names of rows that a
/// specification must give. A row "alpha" is the width of the slopes of its facets.
template <typename Settings>
BsdfModel bsdf_model(std::string name, std::string label, std::string doc,
                     ParamTable<Settings> table,
                     std::function<std::unique_ptr<Bsdf>(const Settings&)> make,
                     const std::vector<std::string>& required = {}) {
    BsdfModel model{std::move(name), std::move(label), std::move(doc), {}, {}};
    for (const Param<Settings>& row : table) {
        const bool must =
            std::find(required.begin(), required.end(), row.info.name) != required.end();
        model.params.push_back({row.info, to_spec_text(row.info, row.default_text()), must});
    }
    if (const Param<Settings>* width = find(table, "alpha"))
        model.with_alpha = [info = width->info](double alpha) {
            return SpecSettings{{info.name, to_spec_text(info, format(info, alpha))}};
        };
    model.make = [table = std::move(table), make = std::move(make)](const SpecSettings& given) {
        Settings settings;
        for (const auto& [key, value] : given) {
            const Param<Settings>* row = find(table, key);
            row->apply(settings, from_spec_text(row->info, value));
        }
        return make(settings);
    };
    return model;
}

}  // namespace asperity
