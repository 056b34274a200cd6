// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/surface_kinds.h>

#include <asperity/core/error.h>
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/surface_params.h>

#include <algorithm>
#include <iterator>
#include <mutex>

namespace asperity {

namespace {

struct Registry {
    std::mutex mutex;
    std::vector<SurfaceKind> kinds;

    Registry() {
        for (const auto make : generators::kBuiltin) kinds.push_back(make());
    }

    /// Or nullptr. With the mutex locked, as long as it is.
    const SurfaceKind* find(std::string_view name) const {
        const auto found = std::find_if(kinds.begin(), kinds.end(),
                                        [&](const SurfaceKind& kind) { return kind.name == name; });
        return found == kinds.end() ? nullptr : &*found;
    }
};

Registry& registry() {
    static Registry registry;
    return registry;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<SurfaceKind> surface_kinds() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.kinds;
}

std::optional<SurfaceKind> find_surface_kind(std::string_view name) {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    const SurfaceKind* found = all.find(name);
    return found == nullptr ? std::nullopt : std::optional(*found);
}

void add_surface_kind(SurfaceKind kind) {
    const auto refuse_kind = [&](std::string why) {
        throw Error(ErrorCode::Usage, std::move(why), kind.name);
    };
    if (kind.name.empty()) refuse_kind("a kind of surface needs a name");
    if (!kind.fill) refuse_kind("a kind of surface needs a function that makes the heights");
    if (kind.name == kSurfaceFile || find_surface_kind(kind.name))
        refuse_kind("there is a kind of surface of that name");
    const ParamTable<SurfaceSettings> known = surface_params();
    for (const Param<SurfaceSettings>& param : kind.own)
        if (param.info.name.empty() || find(known, param.info.name))
            refuse_kind("'" + param.info.name + "' is empty or another setting's name");
    for (const std::string& name : kind.params)
        if (!find(known, name)) refuse_kind("there is no setting '" + name + "' to use");
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.kinds.push_back(std::move(kind));
}

bool surface_uses(const std::string& kind, std::string_view setting) {
    for (const char* name : {"surface", "cell-size", "height-scale", "diagonal", "boundary"})
        if (setting == name) return true;
    if (kind == kSurfaceFile) {
        constexpr std::string_view kOfFiles[] = {"tiling",   "format",   "channel",  "decimal",
                                                 "fill",     "outliers", "level",    "filter-s",
                                                 "filter-l", "crop",     "resample", "wavelength"};
        return std::find(std::begin(kOfFiles), std::end(kOfFiles), setting) != std::end(kOfFiles);
    }
    if (setting == "size") return true;
    // Asked for every setting of every kind: nothing is copied
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    const SurfaceKind* found = all.find(kind);
    return found != nullptr && (contains(found->params, setting) || find(found->own, setting));
}

}  // namespace asperity
