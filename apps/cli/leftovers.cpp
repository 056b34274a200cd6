// SPDX-License-Identifier: Apache-2.0
#include "leftovers.h"

#include "option_names.h"
#include "swapped.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/params/suggest.h>
#include <asperity/surface/surface_kinds.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace asperity::cli {

namespace {

using Words = std::vector<std::string>;

[[noreturn]] void refuse(const std::string& why) {
    throw Error(ErrorCode::Usage, why);
}

bool is_option(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

Words option_names(const CLI::App& verb) {
    Words names;
    for (const CLI::Option* option : verb.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back(name);
    return names;
}

bool exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

/// "--alpha=3" and "-alpha" are "alpha".
std::string bare(const std::string& word) {
    const std::string typed = word.substr(0, word.find('='));
    return typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
}

/// What a word without dashes was probably meant for.
std::string meaning(const CLI::App& verb, const std::string& word) {
    const auto has = [&](const char* name) {
        return verb.get_option_no_throw(std::string("--") + name) != nullptr;
    };
    const bool surface = find_surface_kind(word.substr(0, word.find(':'))).has_value();
    if (has("surface") && (surface || exists(word)))
        return "; did you mean --surface " + word + "?";
    if (has("brdf") && (is_brdf_spec(word) || exists(word)))
        return "; did you mean --brdf " + word + "?";
    const std::string symbol = material_called(word);
    if (has("material") && !symbol.empty()) return "; did you mean --material " + symbol + "?";
    if (parse_double(word)) return "; the numbers of one option stand together: 0,30,60";
    if (word == "percent" || word == "%") return "; it stands behind its number: 1%";
    if (has(bare(word).c_str())) return "; did you mean --" + bare(word) + "?";
    return fmt::format("; asperity help {} tells what it takes", verb.get_name());
}

[[noreturn]] void refuse_verb(const CLI::App& program, const Words& leftovers) {
    const Words names = verb_names(program);
    if (leftovers.empty())
        refuse(fmt::format("no verb given ({}); asperity help explains", fmt::join(names, ", ")));
    const std::string& word = leftovers.front();
    if (is_option(word))
        refuse(fmt::format("{}: the verb comes first: asperity VERB {} ... ({})", word, word,
                           fmt::join(names, ", ")));
    std::string meant = word == "sweep" ? "; it comes with the Python package, as asperity-sweep"
                                        : did_you_mean(word, names);
    if (meant.empty() && find_surface_kind(word.substr(0, word.find(':'))))
        meant = fmt::format("; did you mean asperity surface {}?", word);
    else if (meant.empty() && exists(word))
        meant = fmt::format("; did you mean asperity info {}?", word);
    else if (meant.empty())
        meant = "; asperity help lists them";
    refuse(fmt::format("unknown verb '{}'{}", word, meant));
}

/// For an option that the verb does not have.
std::string option_meant(const CLI::App& program, const CLI::App& verb, const std::string& name) {
    const bool own = name.size() > 1 && verb.get_option_no_throw("--" + name) != nullptr;
    for (const CLI::App* other : program.get_subcommands({}))
        if (!own && name.size() > 1 && other->get_option_no_throw("--" + name) != nullptr)
            return fmt::format("; asperity {} has it", other->get_name());
    const std::string meant = nearest(name, option_names(verb));
    if (!meant.empty()) return "; did you mean --" + meant + "?";
    return fmt::format("; asperity help {} lists them", verb.get_name());
}

}  // namespace

void refuse_leftovers(const CLI::App& program) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    Words leftovers = program.remaining();
    if (chosen.empty()) refuse_verb(program, leftovers);
    const CLI::App& verb = *chosen.front();
    if (!leftovers.empty())
        refuse(fmt::format("'{}' stands before the verb: asperity {} ... takes options and files",
                           leftovers.front(), verb.get_name()));
    leftovers = verb.remaining();
    // It ends the options
    const auto mark = std::find(leftovers.begin(), leftovers.end(), "--");
    if (mark != leftovers.end()) leftovers.erase(mark);
    if (leftovers.empty()) return;
    const auto option = std::find_if(leftovers.begin(), leftovers.end(), is_option);
    if (option == leftovers.end())
        refuse(fmt::format("{} does not know what to do with '{}'{}", verb.get_name(),
                           leftovers.front(), meaning(verb, leftovers.front())));
    const std::string typed = option->substr(0, option->find('='));
    refuse(fmt::format("{} has no option {}{}", verb.get_name(), typed,
                       option_meant(program, verb, bare(typed))));
}

}  // namespace asperity::cli
