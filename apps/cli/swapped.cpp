// SPDX-License-Identifier: Apache-2.0
#include "swapped.h"

#include "option_names.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/optics/materials.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace asperity::cli {

namespace {

using Words = std::vector<std::string>;

bool contains(const Words& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// A value that was refused, and where it stood.
struct Refused {
    std::string option;  ///< without dashes; of a positional its name
    bool positional = false;
    std::string text;  ///< "ggx:alpha=0.3"
    std::string word;  ///< "ggx"
};

/// The option that an error names, or whose value it names.
std::optional<Refused> refused_by(const CLI::App& verb, const Error& error) {
    for (const CLI::Option* option : verb.get_options()) {
        if (option->count() == 0 || option->results().empty()) continue;
        const Words& values = option->results();
        const Words& names = option->get_lnames();
        const bool surface = option->get_positional() && option->get_single_name() == "spec";
        const bool named =
            contains(names, error.where()) || (surface && error.where() == "surface");
        if (!named && !contains(values, error.where())) continue;
        const std::string text = named ? values.back() : error.where();
        return Refused{names.empty() ? option->get_single_name() : names.front(),
                       option->get_positional(), text, text.substr(0, text.find(':'))};
    }
    return std::nullopt;
}

bool has(const CLI::App& verb, const char* option) {
    return verb.get_option_no_throw(std::string("--") + option) != nullptr;
}

/// Another option of the verb that takes this name.
std::string other_option(const CLI::App& verb, const Refused& refused) {
    if (refused.positional && is_brdf_spec(refused.text)) return {};  // a model where one may be
    for (const CLI::Option* option : verb.get_options()) {
        if (option->get_positional() || option->get_lnames().empty()) continue;
        const std::string& name = option->get_lnames().front();
        const Words words = names_for(verb, name);
        if (name == refused.option || !contains(words, refused.word)) continue;
        if (refused.word == "none" || refused.word == "auto" || refused.word == "all") continue;
        return fmt::format("did you mean --{} {}?", name, refused.text);
    }
    return {};
}

std::string material_cure(const CLI::App& verb, const Refused& refused) {
    const std::string symbol = material_called(refused.word);
    if (symbol.empty() || refused.option == "material") return {};
    if (has(verb, "material")) return fmt::format("did you mean --material {}?", symbol);
    const char* option = has(verb, "brdf")                                 ? "--brdf "
                         : verb.get_name() == "fit" && !refused.positional ? "--model "
                                                                           : "";
    const char* width = verb.get_name() == "fit" && !refused.positional ? "" : "alpha=0.3,";
    return fmt::format("a material is the key of a model: {}ggx:{}material={}", option, width,
                       symbol);
}

/// A file where a name was wanted, a number for what has its own option.
std::string thing_cure(const CLI::App& verb, const Refused& refused) {
    std::error_code ignored;
    if (!refused.positional && std::filesystem::is_regular_file(refused.text, ignored)) {
        for (const char* option : {"surface", "brdf"})
            if (has(verb, option) && refused.option != option)
                return fmt::format("did you mean --{} {}?", option, refused.text);
    }
    const std::optional<double> number = parse_double(refused.text);
    const bool reflects = refused.option == "fresnel" || refused.option == "material";
    if (number && reflects && has(verb, "f0"))
        return fmt::format("did you mean --{} {}?", *number < 1 ? "f0" : "ior", refused.text);
    return {};
}

/// A surface or a model where a file is wanted.
std::string source_cure(const CLI::App& verb, const Refused& refused) {
    const bool model = is_brdf_spec(refused.text);
    if (!has(verb, "surface") && !model && find_surface_kind(refused.word))
        return fmt::format(
            "it is a kind of surface: asperity simulate --surface {} -o X.asperity measures it",
            refused.text);
    if (model && refused.positional)
        return "it is a model: asperity compare, export, fit, plot and render take models";
    return {};
}

/// The formats of a program's name, "mitsuba", or of an ending.
std::string format_cure(const CLI::App& verb, const Refused& refused) {
    if (refused.option != "format" || verb.get_name() != "export" || refused.word.size() < 3)
        return {};
    Words by_ending, by_program;
    const std::string word = lower(refused.word);
    const io::BsdfFormats formats;
    for (const io::BsdfFormat& format : formats.rows()) {
        if (!format.write) continue;
        if (contains(format.endings, word)) by_ending.push_back(format.name);
        if (lower(format.doc).find(word) != std::string::npos) by_program.push_back(format.name);
    }
    const Words& names = by_ending.empty() ? by_program : by_ending;
    return names.empty() ? "" : fmt::format("did you mean {}?", fmt::join(names, " or "));
}

/// A law of reflection by its name, where a fit has words for what is free of it.
std::string reflectance_cure(const Refused& refused) {
    if (refused.option != "reflectance") return {};
    for (const auto& [law, word] : {std::pair{"schlick", "f0"}, std::pair{"dielectric", "ior"}})
        if (refused.word == law) return fmt::format("did you mean {}?", word);
    return {};
}

/// "ggx:material=Au" as a surface: the setting is an option.
std::string setting_cure(const CLI::App& verb, const Refused& refused) {
    if (refused.option != "surface" && refused.option != "spec") return {};
    const std::size_t colon = refused.text.find(':');
    if (colon == std::string::npos) return {};
    const std::string settings = refused.text.substr(colon + 1);
    for (const std::string_view piece : split(settings, ',')) {
        const std::string key(piece.substr(0, piece.find('=')));
        if (piece.find('=') == piece.npos || !contains({"material", "fresnel", "f0", "ior"}, key))
            continue;
        const std::string value(piece.substr(piece.find('=') + 1));
        return has(verb, key.c_str())
                   ? fmt::format("did you mean --{} {}?", key, value)
                   : fmt::format("asperity simulate takes it: --{} {}", key, value);
    }
    return {};
}

}  // namespace

std::string material_called(const std::string& word) {
    for (const TabulatedMaterial& material : materials())
        if (lower(word) == lower(std::string(material.symbol)) ||
            lower(word) == lower(std::string(material.name)))
            return std::string(material.symbol);
    return {};
}

Error with_cure_of_swap(const CLI::App& verb, const Error& error) {
    if (error.code() != ErrorCode::Usage && error.code() != ErrorCode::InputOutput) return error;
    const std::optional<Refused> refused = refused_by(verb, error);
    if (!refused) return error;
    const Words own = names_for(verb, refused->option);
    if (contains(own, refused->text)) return error;
    // A guess by letters gives way to a name that is known elsewhere; other cures stay.
    std::string message = error.message();
    const std::size_t guess = message.find("; did you mean");
    const bool cured = message.find("asperity ") != message.npos;
    if (cured) return error;
    if (contains(own, refused->word)) {  // something behind the name is wrong
        const bool setting = message.find("is no setting") != message.npos;
        const std::string cure = setting ? setting_cure(verb, *refused) : "";
        return cure.empty()
                   ? error
                   : Error(error.code(), message.substr(0, guess) + "; " + cure, error.where());
    }
    for (const std::string& cure :
         {reflectance_cure(*refused), format_cure(verb, *refused), material_cure(verb, *refused),
          other_option(verb, *refused), source_cure(verb, *refused)})
        if (!cure.empty())
            return Error(error.code(), message.substr(0, guess) + "; " + cure, error.where());
    const std::string cure = guess == message.npos ? thing_cure(verb, *refused) : "";
    return cure.empty() ? error : Error(error.code(), message + "; " + cure, error.where());
}

}  // namespace asperity::cli
