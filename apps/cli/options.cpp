// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include "console.h"
#include "file_kind.h"

#include <asperity/core/error.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/optics/fresnel.h>
#include <asperity/params/suggest.h>
#include <asperity/surface/surface_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace asperity::cli {

namespace {

/// The heading in help of a group of settings.
const char* heading(const std::string& group) {
    for (const auto& [name, shown] :
         {std::pair{"Surface", kSurface}, std::pair{"Light", kLight}, std::pair{"Optics", kFacets},
          std::pair{"Rays", kRun}, std::pair{"Detector", kDetector}})
        if (group == name) return shown;
    return kRun;
}

/// The option of a setting; help shows the default where the row does not say what holds.
CLI::Option* add_option(CLI::App& app, const Param<Experiment>& param) {
    const ParamInfo& info = param.info;
    const std::string name = "--" + info.name, help = help_text(info);
    if (info.type == ParamType::Flag) return app.add_flag(name, help)->group(heading(info.group));
    return add_text(app, name, metavar(info), help, heading(info.group))
        ->default_str(info.otherwise.empty() ? param.default_text() : info.otherwise);
}

std::vector<std::string> long_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const auto& param : experiment_params()) names.push_back(param.info.name);
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back(name);
    }
    return names;
}

/// A settings file may also be a pipe, as the shell's <(...) makes one; io's readers want files.
std::string read_text_file(const std::string& path) {
    constexpr std::streamsize kMostBytes = 1 << 20;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw Error(ErrorCode::InputOutput, "is a folder", path);
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(ErrorCode::InputOutput, std::strerror(errno), path);
    std::string text(static_cast<std::size_t>(kMostBytes) + 1, '\0');
    file.read(text.data(), kMostBytes + 1);
    if (file.bad()) throw Error(ErrorCode::InputOutput, "cannot be read", path);
    if (file.gcount() > kMostBytes) {
        throw Error(ErrorCode::InvalidInput, "is longer than a settings file can be (1 MiB)", path);
    }
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

/// "1,5" may be meant as 1.5, and stands for two bands.
void tell_two_bands(const std::string& key, const std::string& value) {
    if (key != "ior" && key != "k" && key != "f0") return;
    const std::size_t comma = value.find(',');
    const auto digits = [](const std::string& text) {
        return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    if (comma == value.npos || !digits(value.substr(0, comma)) || !digits(value.substr(comma + 1)))
        return;
    write_err(
        fmt::format("asperity: note: --{} {} is two bands, {} and {}; one number of that "
                    "kind is written {}.{}\n",
                    key, value, value.substr(0, comma), value.substr(comma + 1),
                    value.substr(0, comma), value.substr(comma + 1)));
}

}  // namespace

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& metavar,
                      const std::string& help, const std::string& group) {
    const CLI::callback_t nothing = [](const CLI::results_t&) { return true; };
    return app.add_option(name, nothing, help)
        ->type_name(metavar)
        ->group(group)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

CLI::Option* add_option(CLI::App& app, const OptionInfo& info, const std::string& otherwise) {
    const std::string name = std::string("--") + info.name;
    if (*info.metavar == '\0') return app.add_flag(name, info.help)->group(info.group);
    return add_text(app, name, info.metavar, info.help, info.group)->default_str(otherwise);
}

std::string text_of(const CLI::Option* option, const std::string& otherwise) {
    return option->count() == 0 ? otherwise : option->results().back();
}

int parse_count(const std::string& name, const std::string& text, int least, int most) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || value < least || value > most) {
        throw Error(ErrorCode::Usage,
                    fmt::format("'{}' is not a whole number from {} to {}", text, least, most),
                    name);
    }
    return value;
}

double parse_positive(const std::string& name, const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value) || value <= 0) {
        throw Error(ErrorCode::Usage, fmt::format("'{}' is not a number above 0", text), name);
    }
    return value;
}

void ThreadsOption::add_to(CLI::App& app) {
    option =
        add_text(app, "--threads", "T", "threads to compute with; no influence on the result", kRun)
            ->default_str("all");
}

int ThreadsOption::threads() const {
    constexpr int kMostThreads = 1024;
    const bool all = option->count() == 0 || text_of(option) == "all";
    return all ? 0 : parse_count("threads", text_of(option), 1, kMostThreads);
}

void ExperimentOptions::add_to(CLI::App& app, std::initializer_list<const char*> groups,
                               bool surface_option) {
    app_ = &app;
    for (const Param<Experiment>& param : experiment_params()) {
        const std::string& key = param.info.name;
        const bool wanted = std::any_of(groups.begin(), groups.end(), [&](const char* group) {
            return std::strcmp(group, heading(param.info.group)) == 0;
        });
        if (wanted && (key != "surface" || surface_option))
            options_.emplace_back(key, add_option(app, param));
    }
    config_ = add_text(app, "--config", "FILE",
                       "read options from a text file of lines 'rays = 100000'; the command line "
                       "wins",
                       kRun);
}

Experiment ExperimentOptions::read(const std::string& spec) {
    Experiment experiment;
    if (config_->count() > 0) apply_config(experiment, text_of(config_));
    if (!spec.empty()) apply_surface_spec(experiment.surface, spec);
    const auto given = [&](const char* key) {
        const CLI::Option* option = app_->get_option_no_throw(std::string("--") + key);
        return option && option->count() > 0;
    };
    if (given("layers") && given("theta"))
        throw Error(ErrorCode::Usage, "it has no effect beside --theta", "layers");
    // Angles asked for by layers replace the fixed angles of a config file.
    if (given("layers")) experiment.illumination.theta_deg.clear();
    for (const auto& [key, option] : options_) {
        if (option->count() == 0) continue;
        const std::string value = text_of(option);
        if (value.find_first_not_of(" \t") == value.npos)
            throw Error(ErrorCode::Usage, "the value is empty", key);
        apply_setting(experiment, key, value);
        tell_two_bands(key, value);
    }
    refuse_unused(experiment);
    // Perfect mirrors have neither index nor material: who gives one means what it implies. A
    // config file that says both means what it says.
    FresnelKind& fresnel = experiment.optics.fresnel;
    const bool hinted = given("f0") || given("ior") || given("k") || given("material");
    if (fresnel == FresnelKind::None && !given("fresnel") && (hinted || !fresnel_in_config_))
        fresnel = implied_fresnel(experiment.optics);
    tell_unused(experiment);
    return experiment;
}

void ExperimentOptions::refuse_unused(const Experiment& experiment) const {
    const ParamTable<Experiment> table = experiment_params();
    for (const auto& [key, option] : options_) {
        const Param<Experiment>* param = find(table, key);
        if (option->count() == 0 || param->used(experiment)) continue;
        throw Error(ErrorCode::Usage, param->unused(experiment), key);
    }
}

void ExperimentOptions::tell_unused(const Experiment& experiment) const {
    const ParamTable<Experiment> table = experiment_params();
    for (const auto& [key, where] : config_lines_) {
        const Param<Experiment>* param = find(table, key);
        if (param->used(experiment) || param->text(experiment) == param->default_text()) continue;
        write_err(fmt::format("asperity: note: {}: {} has no effect: {}\n", where, key,
                              param->unused(experiment)));
    }
}

bool ExperimentOptions::any_given() const {
    return std::any_of(options_.begin(), options_.end(),
                       [](const auto& entry) { return entry.second->count() > 0; });
}

void ExperimentOptions::apply_config(Experiment& experiment, const std::string& path) {
    const ParamTable<Experiment> table = experiment_params();
    refuse_known_kind(path, "settings", "asperity info FILE --config prints those of a result");
    std::vector<Setting> settings = parse_settings(read_text_file(path), path);
    // Sections belong to other programs, such as the studio.
    std::erase_if(settings, [](const Setting& s) { return !s.section.empty(); });
    // The surface first: its text may carry settings that single lines correct.
    std::stable_partition(settings.begin(), settings.end(),
                          [](const Setting& s) { return s.key == "surface"; });
    for (const Setting& setting : settings) {
        const std::string where = fmt::format("{}:{}", path, setting.line);
        CLI::Option* option = app_->get_option_no_throw("--" + setting.key);
        // What somebody else's file says must not replace a file of the user's
        if (setting.key == "output")
            throw Error(ErrorCode::InvalidInput,
                        "a file of settings may not name the output; say it with -o", where);
        if (setting.key == "fresnel") fresnel_in_config_ = true;
        if (find(table, setting.key)) {
            try {
                apply_setting(experiment, setting.key, setting.value);
            } catch (const Error& error) {
                throw Error(ErrorCode::InvalidInput, error.what(), where);
            }
            config_lines_.emplace_back(setting.key, where);
        } else if (option && option != config_ && option != app_->get_help_ptr()) {
            if (option->count() > 0) continue;
            try {
                option->add_result(option->get_items_expected_max() == 0
                                       ? option->get_flag_value(setting.key, setting.value)
                                       : setting.value);
                option->run_callback();
            } catch (const CLI::Error& error) {
                throw Error(ErrorCode::InvalidInput, error.what(), where);
            }
        } else {
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("unknown setting '{}'{}", setting.key,
                                    did_you_mean(setting.key, long_names(*app_))),
                        where);
        }
    }
}

}  // namespace asperity::cli
