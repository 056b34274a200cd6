// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/surface_text.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/params/suggest.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_params.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace asperity {

namespace {

constexpr std::string_view kFilePrefix = "file:";

[[noreturn]] void refuse(std::string why) {
    throw Error(ErrorCode::Usage, std::move(why), "surface");
}

bool looks_like_file(std::string_view text) {
    return text.find_first_of("./") != std::string_view::npos;
}

std::vector<std::string> names_of(const ParamTable<SurfaceSettings>& table) {
    std::vector<std::string> names;
    for (const Param<SurfaceSettings>& param : table) names.push_back(param.info.name);
    return names;
}

/// "alpha=0.3/0.1" of a spec.
const Param<SurfaceSettings>& apply_part(const ParamTable<SurfaceSettings>& table,
                                         SurfaceSettings& surface, std::string_view part) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) refuse(in_quotes(part) + " is no 'setting=value'");
    const std::string name(trimmed(part.substr(0, equals)));
    const Param<SurfaceSettings>* param = find(table, name);
    if (param == nullptr || name == "surface")
        refuse(in_quotes(name) + " is no setting of a surface" +
               did_you_mean(name, names_of(table)));
    std::string value(part.substr(equals + 1));
    std::replace(value.begin(), value.end(), '/', ',');
    param->apply(surface, value);
    return *param;
}

void apply_parts(SurfaceSettings& surface, std::string_view parts) {
    const ParamTable<SurfaceSettings> table = surface_params();
    std::vector<const Param<SurfaceSettings>*> given;
    for (const std::string_view part : split(parts, ','))
        given.push_back(&apply_part(table, surface, part));
    for (const Param<SurfaceSettings>* param : given)
        if (const std::string why = param->unused(surface); !why.empty()) refuse(param->info, why);
}

/// For "gaussian alpha=0.3" and "gaussian,alpha=0.3", which would be taken for files.
void refuse_other_marks(std::string_view text) {
    const std::size_t end = text.find_first_of(" ,;");
    std::error_code ignored;
    if (end == text.npos || text.find('=') == text.npos ||
        std::filesystem::exists(std::string(text), ignored))
        return;
    const auto kind = find_surface_kind(text.substr(0, end));
    if (!kind) return;
    refuse(fmt::format("{}: a kind and its settings are written as {}:setting=value,setting=value",
                       in_quotes(text), kind->name));
}

void set_file(SurfaceSettings& surface, std::string_view name) {
    if (name.empty()) refuse("the file name is empty");
    surface.kind = kSurfaceFile;
    surface.file = name;
}

}  // namespace

void apply_surface_spec(SurfaceSettings& surface, const std::string& spec) {
    if (spec.starts_with(kFilePrefix))
        return set_file(surface, std::string_view(spec).substr(kFilePrefix.size()));

    const std::string_view text = trimmed(spec);
    const std::size_t colon = text.find(':');
    if (const auto kind = find_surface_kind(trimmed(text.substr(0, colon)))) {
        SurfaceSettings changed = surface;
        changed.kind = kind->name;
        changed.file.clear();
        if (colon != std::string_view::npos) apply_parts(changed, text.substr(colon + 1));
        surface = std::move(changed);
        return;
    }
    std::error_code ignored;
    refuse_other_marks(text);
    if (looks_like_file(text) || std::filesystem::exists(std::string(text), ignored))
        return set_file(surface, text);

    std::vector<std::string> known;
    for (const SurfaceKind& kind : surface_kinds()) known.push_back(kind.name);
    refuse(fmt::format("{} is neither a file nor one of {}{}", in_quotes(text),
                       fmt::join(known, ", "),
                       did_you_mean(std::string(text.substr(0, colon)), known)));
}

std::string surface_text(const SurfaceSettings& surface) {
    if (surface.kind != kSurfaceFile) return surface.kind;
    const std::string_view file = surface.file;
    const bool plain = looks_like_file(file) && trimmed(file) == file &&
                       !file.starts_with(kFilePrefix) &&
                       !find_surface_kind(trimmed(file.substr(0, file.find(':'))));
    return plain ? surface.file : std::string(kFilePrefix) + surface.file;
}

}  // namespace asperity
