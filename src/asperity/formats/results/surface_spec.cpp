// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/surface_spec.h>

#include <asperity/formats/results/experiment_keys.h>
#include <asperity/formats/results/experiment_text.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace asperity::io {
namespace {

constexpr Names<SurfaceKind, 10> kKinds = {{
    {"thesis", SurfaceKind::Thesis},
    {"gaussian", SurfaceKind::Gaussian},
    {"ggx", SurfaceKind::Ggx},
    {"flat", SurfaceKind::Flat},
    {"tilted", SurfaceKind::Tilted},
    {"vgroove", SurfaceKind::VGroove},
    {"sawtooth", SurfaceKind::Sawtooth},
    {"pyramids", SurfaceKind::Pyramids},
    {"sinusoid", SurfaceKind::Sinusoid},
    {"eggcrate", SurfaceKind::Eggcrate},
}};
constexpr std::string_view kFilePrefix = "file:";

std::optional<SurfaceKind> kind_named(std::string_view name) {
    for (const auto& [known, kind] : kKinds)
        if (name == known) return kind;
    return std::nullopt;
}

bool looks_like_file(std::string_view text) {
    return text.find_first_of("./") != std::string_view::npos;
}

// "alpha=0.3/0.1" of a spec.
void apply_part(Experiment& experiment, std::string_view part, const SettingValue& spec) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) spec.refuse(in_quotes(part) + " is no 'setting=value'");
    const std::string name(trimmed(part.substr(0, equals)));
    const ExperimentKey* key = find_experiment_key(name);
    if (key == nullptr || key->group != std::string_view(kSurfaceGroup) || name == "surface")
        spec.refuse(in_quotes(name) + " is no setting of a surface");
    std::string value(part.substr(equals + 1));
    std::replace(value.begin(), value.end(), '/', ',');
    key->set(experiment, SettingValue(name, value));
}

void set_file(SurfaceSettings& surface, std::string_view name, const SettingValue& value) {
    if (name.empty()) value.refuse("the file name is empty");
    surface.kind = SurfaceKind::File;
    surface.file = name;
}

}  // namespace

void set_surface(SurfaceSettings& surface, const SettingValue& value) {
    const std::string_view text = value.text();
    if (value.raw().starts_with(kFilePrefix))
        return set_file(surface, value.raw().substr(kFilePrefix.size()), value);

    const std::size_t colon = text.find(':');
    if (const auto kind = kind_named(trimmed(text.substr(0, colon)))) {
        Experiment experiment;
        experiment.surface = surface;
        experiment.surface.kind = *kind;
        experiment.surface.file.clear();
        if (colon != std::string_view::npos)
            for (const std::string_view part : split(text.substr(colon + 1), ','))
                apply_part(experiment, part, value);
        surface = experiment.surface;
        return;
    }
    std::error_code ignored;
    if (looks_like_file(text) || std::filesystem::exists(std::string(text), ignored))
        return set_file(surface, text, value);

    std::string known;
    for (const auto& [name, kind] : kKinds) known += std::string(known.empty() ? "" : ", ") + name;
    value.refuse(fmt::format("{} is neither a file nor one of {}", in_quotes(text), known));
}

std::string surface_text(const SurfaceSettings& surface) {
    if (surface.kind != SurfaceKind::File) return text_of(kKinds, surface.kind);
    const std::string_view file = surface.file;
    const bool plain = looks_like_file(file) && trimmed(file) == file &&
                       !file.starts_with(kFilePrefix) &&
                       !kind_named(trimmed(file.substr(0, file.find(':'))));
    return plain ? surface.file : std::string(kFilePrefix) + surface.file;
}

void apply_surface_spec(SurfaceSettings& surface, const std::string& spec) {
    const std::string key = "surface";
    set_surface(surface, SettingValue(key, spec));
}

}  // namespace asperity::io
