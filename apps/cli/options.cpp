// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <asperity/core/error.h>
#include <asperity/formats/results/experiment_text.h>
#include <asperity/optics/fresnel.h>
#include <asperity/params/suggest.h>

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

/// The options of an experiment, by their keys. Help shows the default of the library where the
/// table says nothing.
constexpr OptionInfo kOptions[] = {
    {"surface", "SPEC|FILE", kSurface,
     "thesis, gaussian, ggx, flat, tilted, vgroove, sawtooth, pyramids, sinusoid, eggcrate, or a "
     "file of heights (.gsf .exr .png .txt); settings may follow: gaussian:alpha=0.3,size=256"},
    {"size", "N", kSurface, "samples on a side, 2 to 32768"},
    {"roughness", "R", kSurface, "thesis: heights are uniform in 0 to 10 R cells; 0 to 1"},
    {"alpha", "A[,AY]", kSurface,
     "gaussian, ggx: width of the slope distribution (Beckmann's or GGX' alpha) along x and y"},
    {"correlation-length", "L[,LY]", kSurface, "gaussian, ggx: correlation lengths in cells"},
    {"autocorrelation", "NAME", kSurface, "gaussian: gaussian, exponential or self-affine"},
    {"hurst", "H", kSurface, "self-affine: Hurst exponent, above 0, up to 1"},
    {"max-slope", "S", kSurface, "ggx: steeper facets are cut to this slope"},
    {"surface-seed", "K", kSurface, "seed of the random surfaces"},
    {"tilt", "D", kSurface, "tilted, vgroove, sawtooth, pyramids: tilt of the facets in degrees"},
    {"period", "N", kSurface, "shapes: cells per period; must divide the size"},
    {"amplitude", "A", kSurface, "sinusoid, eggcrate: amplitude in cells"},
    {"along-y", "", kSurface, "shapes vary along y, not along x"},
    {"tiling", "NAME", kSurface,
     "files: periodic (they repeat as they are), mirror (made periodic by mirroring), finite (a "
     "patch "
     "with edges) or auto (periodic if the file says so or its opposite edges fit, else mirror)"},
    {"boundary", "NAME", kSurface, "made surfaces: periodic, or finite (a patch with edges)"},
    {"cell-size", "C[,CY]", kSurface, "distance of the samples", "1 cell, or what the file says"},
    {"height-scale", "H", kSurface, "multiplies the heights after all else"},
    {"diagonal", "NAME", kSurface, "how a cell is cut into two triangles: anti (thesis) or main"},

    {"layers", "N", kLight,
     "thesis layers: layer k of N stands at elevation 90 k / N degrees, the last is normal "
     "incidence"},
    {"theta", "D[,D...]", kLight, "incident polar angles in degrees, 0 to below 90",
     "the layers' angles"},
    {"phi", "D[,D...]", kLight,
     "azimuths the light comes from in degrees; every theta x every phi"},
    {"isotropic", "", kLight, "random azimuth per ray, outgoing azimuth relative to it"},

    {"fresnel", "NAME", kFacets, "none (perfect mirrors), schlick, dielectric or conductor",
     "what the options below imply"},
    {"f0", "X[,Y,Z]", kFacets, "schlick: reflectance along the normal, one or per channel",
     "from --ior"},
    {"ior", "N[,...]", kFacets, "index of refraction (its real part)", "none"},
    {"k", "K[,...]", kFacets, "conductor: imaginary part of the index", "none"},
    {"material", "NAME", kFacets, "conductor: Al, Ag, Au, Cu, Cr, Fe, Ni or Ti", "none"},
    {"wavelengths", "L[,L...]", kFacets, "of a material, in nm, 400 to 700",
     "650,550,450: red, green, blue"},

    {"detector", "NAME", kDetector,
     "latlong (rows equal in angle, the thesis' sky-map) or equal-area (cells of equal projected "
     "solid angle)"},
    {"resolution", "R", kDetector, "R columns x R/2 rows of outgoing directions"},
    {"orders", "N", kDetector,
     "bounce orders kept apart per cell; the last one holds all higher ones"},

    {"bounces", "B", kRun, "reflections a ray may make; what still travels then is truncated"},
    {"jitter", "J", kRun, "rays per surface cell and layer (the thesis' Camera Jitter)",
     "16, or fewer on more than 4 million cells"},
    {"rays", "N", kRun, "rays per layer, in place of --jitter", "jitter x cells"},
    {"until", "P[,Q]", kRun,
     "go on until the relative standard error of the albedo is below P, and that of the cells with "
     "90 % of the energy below Q (P if not given): 1% or 0.01",
     "one pass"},
    {"max-rays", "N", kRun, "with --until: no more rays per layer than this",
     "256 x the first estimate"},
    {"launch", "NAME", kRun, "launch points: low-discrepancy, stratified or random"},
    {"batches", "N", kRun, "independent batches per layer, from which errors are estimated"},
    {"seed", "K", kRun, "seed of the rays; same settings, same seed: same result"},
};

const OptionInfo* find(const std::string& key) {
    const auto* info = std::find_if(std::begin(kOptions), std::end(kOptions),
                                    [&](const OptionInfo& o) { return key == o.name; });
    return info == std::end(kOptions) ? nullptr : info;
}

std::string default_of(const OptionInfo& info) {
    if (*info.otherwise) return info.otherwise;
    static const std::vector<io::Setting> defaults = io::settings_of(Experiment{});
    for (const io::Setting& setting : defaults) {
        if (setting.key == info.name) return setting.value;
    }
    return {};
}

std::vector<std::string> long_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const OptionInfo& info : kOptions) names.emplace_back(info.name);
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
    return option->count() == 0 ? 0 : parse_count("threads", text_of(option), 1, kMostThreads);
}

void ExperimentOptions::add_to(CLI::App& app, std::initializer_list<const char*> groups,
                               bool surface_option) {
    app_ = &app;
    for (const OptionInfo& info : kOptions) {
        const bool wanted = std::any_of(groups.begin(), groups.end(), [&](const char* group) {
            return std::strcmp(group, info.group) == 0;
        });
        const std::string key = info.name;
        if (!wanted || (key == "surface" && !surface_option)) continue;
        options_.emplace_back(key, add_option(app, info, default_of(info)));
    }
    config_ = add_text(app, "--config", "FILE",
                       "read options from a text file of lines 'rays = 100000'; the command line "
                       "wins",
                       kRun);
}

Experiment ExperimentOptions::read(const std::string& spec) {
    Experiment experiment;
    if (config_->count() > 0) apply_config(experiment, text_of(config_));
    if (!spec.empty()) io::apply_surface_spec(experiment.surface, spec);
    const auto given = [&](const char* key) {
        const CLI::Option* option = app_->get_option_no_throw(std::string("--") + key);
        return option && option->count() > 0;
    };
    // Angles asked for by layers replace the fixed angles of a config file.
    if (given("layers") && !given("theta")) experiment.illumination.theta_deg.clear();
    for (const auto& [key, option] : options_) {
        if (option->count() == 0) continue;
        const std::string value = text_of(option);
        if (value.find_first_not_of(" \t") == value.npos)
            throw Error(ErrorCode::Usage, "the value is empty", key);
        io::apply_setting(experiment, key, value);
        note_given(key);
    }
    // Perfect mirrors have neither index nor material: who gives one means what it implies. A
    // config file that says both means what it says.
    FresnelKind& fresnel = experiment.optics.fresnel;
    const bool hinted = given("f0") || given("ior") || given("k") || given("material");
    if (fresnel == FresnelKind::None && !given("fresnel") && (hinted || !fresnel_in_config_))
        fresnel = implied_fresnel(experiment.optics);
    return experiment;
}

void ExperimentOptions::note_given(const std::string& key) {
    if (key == "jitter" || key == "rays") rays_given_ = true;
}

bool ExperimentOptions::any_given() const {
    return std::any_of(options_.begin(), options_.end(),
                       [](const auto& entry) { return entry.second->count() > 0; });
}

void ExperimentOptions::apply_config(Experiment& experiment, const std::string& path) {
    std::vector<io::Setting> settings = io::parse_settings(read_text_file(path), path);
    // Sections belong to other programs, such as the studio.
    std::erase_if(settings, [](const io::Setting& s) { return !s.section.empty(); });
    // The surface first: its text may carry settings that single lines correct.
    std::stable_partition(settings.begin(), settings.end(),
                          [](const io::Setting& s) { return s.key == "surface"; });
    for (const io::Setting& setting : settings) {
        const std::string where = fmt::format("{}:{}", path, setting.line);
        CLI::Option* option = app_->get_option_no_throw("--" + setting.key);
        if (setting.key == "fresnel") fresnel_in_config_ = true;
        note_given(setting.key);
        if (find(setting.key)) {
            try {
                io::apply_setting(experiment, setting.key, setting.value);
            } catch (const Error& error) {
                throw Error(ErrorCode::InvalidInput, error.what(), where);
            }
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
