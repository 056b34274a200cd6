// SPDX-License-Identifier: Apache-2.0
#include "option_names.h"

#include "picture_names.h"
#include "render_options.h"

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/fit/fit.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/optics/materials.h>
#include <asperity/plots/files/plot_file_params.h>
#include <asperity/plots/plot_settings.h>
#include <asperity/surface/surface_kinds.h>

namespace asperity::cli {

namespace {

using Words = std::vector<std::string>;

template <typename Value, std::size_t N>
Words words_of(const Names<Value, N>& names) {
    Words words;
    for (const auto& [name, value] : names) words.emplace_back(name);
    return words;
}

/// Of the options of export for pictures.
Words picture_names(const std::string& option) {
    if (option == "colour-map") return words_of(kColourMaps);
    if (option == "scale") return words_of(kScales);
    if (option == "projection") return words_of(kProjections);
    if (option == "theme") return words_of(kThemes);
    return {};
}

template <typename Settings>
Words choices_in(const ParamTable<Settings>& table, const std::string& name) {
    const Param<Settings>* param = find(table, name);
    return param ? param->info.choices : Words();
}

}  // namespace

std::vector<std::string> verb_names(const CLI::App& program) {
    Words names;
    for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
    return names;
}

Words names_for(const CLI::App& verb, const std::string& option) {
    Words names;
    const io::BsdfFormats bsdfs;
    const io::HeightsFormats heights;
    if (option == "surface" || option == "spec")
        for (const SurfaceKind& kind : surface_kinds()) names.push_back(kind.name);
    else if (option == "material")
        for (const TabulatedMaterial& material : materials()) names.emplace_back(material.symbol);
    else if (option == "brdf" || option == "reference")
        for (const BsdfModel& model : bsdf_models()) names.push_back(model.name);
    else if (option == "format" && verb.get_name() == "export")
        for (const io::BsdfFormat& format : bsdfs.rows())
            if (format.write) names.push_back(format.name);
    if (names.empty() && verb.get_name() == "export") return picture_names(option);
    if (option == "model" && verb.get_name() == "fit")
        for (const BsdfModel& model : bsdf_models()) names.push_back(model.name);
    if (names.empty() && option == "format" && verb.get_option_no_throw("--surface"))
        for (const io::HeightsFormat& format : heights.rows())
            if (format.open) names.push_back(format.name);
    if (verb.get_name() == "plot") {
        if (option == "subjects")
            for (const BsdfModel& model : bsdf_models()) names.push_back(model.name);
        if (names.empty()) names = choices_in(plots::plot_params(), option);
        if (names.empty()) names = choices_in(plots::plot_file_params(), option);
        return names;
    }
    if (names.empty()) names = choices_in(experiment_params(), option);
    if (names.empty() && verb.get_name() == "fit") names = choices_in(fit_params(), option);
    if (names.empty() && verb.get_option_no_throw("--tonemap")) names = render_names(option);
    return names;
}

}  // namespace asperity::cli
