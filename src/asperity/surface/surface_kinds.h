// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/params/fields.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// A kind of surface. Where a function is not set, what its comment says holds.
struct SurfaceKind {
    std::string name = {};   ///< in small letters and dashes: "ggx"
    std::string label = {};  ///< in a form: "GGX"
    std::string doc = {};    ///< one sentence, without a capital and without its full stop
    /// Names of the settings of SurfaceSettings that it uses beyond those of every made surface
    /// (size, boundary, cell-size, height-scale, diagonal).
    std::vector<std::string> params = {};
    /// Settings that no other kind has, made by own_field().
    ParamTable<SurfaceSettings> own = {};

    /// Writes the heights, nx x ny of them in units of dx: the surface has cells of 1 x dy.
    /// Advances `run` by steps(); same settings, same bits, for any number of threads. Throws
    /// Error(Stopped).
    std::function<void(Heightfield&, const SurfaceSettings&, Run&)> fill = {};
    /// Throws Error(Usage, "name of the setting") for settings that do not fit each other; each
    /// alone lies in its range. Not set: all do.
    std::function<void(const SurfaceSettings&)> check = {};
    /// Steps of progress. Not set: one per row of samples.
    std::function<std::uint64_t(const SurfaceSettings&)> steps = {};
    /// True when the statistics of the slopes are the same in all azimuths. Not set: they are not.
    std::function<bool(const SurfaceSettings&)> isotropic = {};
    /// The name of the surface, a line. Not set: the kind and the settings it uses.
    std::function<std::string(const SurfaceSettings&)> describe = {};
    /// Memory it takes at least while it is made, the heights included.
    std::uint64_t bytes_per_sample = sizeof(float);
};

/// All kinds that can be made, in the order of lists: those of the library, then those added.
std::vector<SurfaceKind> surface_kinds();

/// The kind of that name, if there is one.
std::optional<SurfaceKind> find_surface_kind(std::string_view name);

/// Adds a kind, to be known from now on to make_surface, to settings as text and to what is made
/// from them. Call it before other threads use surfaces. Throws Error(Usage, kind.name) when the
/// name or that of one of its own settings is taken or empty, or when `fill` is not set.
void add_surface_kind(SurfaceKind kind);

/// Whether a surface of this kind, kSurfaceFile included, uses a setting.
bool surface_uses(const std::string& kind, std::string_view setting);

/// The value of a setting that one kind alone has.
template <typename T>
T own(const SurfaceSettings& settings, std::string_view name, T fallback) {
    const auto found = settings.own.find(name);
    return found == settings.own.end() ? fallback : std::get<T>(found->second);
}

/// The row of such a setting, for a value of type bool, std::int64_t, std::uint64_t, double or
/// std::string. The kind reads it by own<T>(settings, name, fallback).
template <typename T>
Param<SurfaceSettings> own_field(ParamInfo info, T fallback) {
    info.type = detail::type_of<T>();
    info.written_where_used = true;
    return {info, [=](const SurfaceSettings& s) { return ParamValue(own(s, info.name, fallback)); },
            [=](SurfaceSettings& s, const ParamValue& v) { s.own[info.name] = v; }};
}

}  // namespace asperity
