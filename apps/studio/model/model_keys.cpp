// SPDX-License-Identifier: Apache-2.0
#include "model_keys.h"

#include "model_settings.h"

#include <asperity/core/parse_number.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::studio {
namespace {

using S = StudioSettings;

constexpr const char *kSimulated = "simulated", *kCookTorrance = "cook-torrance";
constexpr double kLeastRoughness = 0.01;
constexpr Range kAlphaRange = {1e-4, 100};
/// Parameters of Cook-Torrance whose keys are older than the list of models.
constexpr std::array kOwnKeys = {"metallic", "roughness", "albedo"};
/// Models whose overlays have keys of their own for the same reason.
constexpr std::array kOwnOverlays = {"cook-torrance", "ggx", "beckmann"};

template <std::size_t N>
bool is_one_of(const std::array<const char*, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

Param<S> text_row(const char* heading, std::string name, std::function<std::string(const S&)> get,
                  std::function<void(S&, const std::string&)> set) {
    Param<S> row;
    row.info = {.name = std::move(name), .group = heading, .type = ParamType::Text};
    row.get = std::move(get);
    row.set = [set = std::move(set)](S& s, const ParamValue& v) {
        set(s, std::get<std::string>(v));
    };
    return row;
}

Param<S> type_row(const char* heading, const std::string& key, BrdfSettings ModelView::*side) {
    return text_row(
        heading, key,
        [side](const S& s) {
            const BrdfSettings& brdf = s.model_view.*side;
            return brdf.type == BrdfType::Simulated ? kSimulated : brdf.model;
        },
        [side, key](S& s, const std::string& name) {
            BrdfSettings& brdf = s.model_view.*side;
            brdf.type = name == kSimulated ? BrdfType::Simulated : BrdfType::Model;
            if (brdf.type == BrdfType::Simulated) return;
            if (!find_bsdf_model(name))
                throw Error(ErrorCode::Usage,
                            fmt::format("{} is none of {}, {}", in_quotes(name), bsdf_model_names(),
                                        kSimulated),
                            key);
            brdf.model = name;
        });
}

/// Metallic, roughness or albedo of Cook-Torrance, as sessions have always written them.
Param<S> cook_torrance_row(const char* heading, const std::string& key, const char* name,
                           BrdfSettings ModelView::*side) {
    const BsdfModel model = *find_bsdf_model(kCookTorrance);
    const BsdfParam& param = *std::find_if(model.params.begin(), model.params.end(),
                                           [&](const auto& p) { return p.info.name == name; });
    Param<S> row = model_row(
        [side](auto& s) -> auto& { return (s.model_view.*side).settings; }, model, param);
    row.info.name = key;
    row.info.group = heading;
    if (param.info.type == ParamType::Real) {
        row.info.range = kZeroToOne;
        if (param.info.range.low == kLeastRoughness)  // older sessions go down to 0
            row.set = [set = row.set](S& s, const ParamValue& v) {
                set(s, std::max(kLeastRoughness, std::get<double>(v)));
            };
    } else {
        row.set = [set = row.set, info = row.info](S& s, const ParamValue& v) {
            if (std::get<std::vector<double>>(v).size() != 3)
                refuse(info, in_quotes(format(info, v)) + " is not three numbers");
            set(s, v);
        };
    }
    return row;
}

/// All settings but those with keys of their own.
ModelSettings further(ModelSettings all) {
    const auto own = all.find(kCookTorrance);
    if (own == all.end()) return all;
    std::erase_if(own->second, [](const auto& s) { return is_one_of(kOwnKeys, s.first); });
    if (own->second.empty()) all.erase(own);
    return all;
}

Param<S> further_row(const char* heading, const std::string& key, const std::string& prefix,
                     BrdfSettings ModelView::*side) {
    Param<S> row = text_row(
        heading, key,
        [side](const S& s) { return to_line(further((s.model_view.*side).settings)); },
        [side, key, prefix](S& s, const std::string& line) {
            ModelSettings& all = (s.model_view.*side).settings;
            ModelSettings given = from_line(key, line);
            for (const auto& [name, text] : given[kCookTorrance])
                if (is_one_of(kOwnKeys, name))
                    throw Error(
                        ErrorCode::Usage,
                        fmt::format("{} of {} is set by {}{}", name, kCookTorrance, prefix, name),
                        key);
            // Those with keys of their own stay as they are.
            for (const auto& setting : all[kCookTorrance])
                if (is_one_of(kOwnKeys, setting.first)) given[kCookTorrance].push_back(setting);
            std::erase_if(given, [](const auto& model) { return model.second.empty(); });
            all = std::move(given);
        });
    row.info.written_unless_default = true;
    return row;
}

Param<S> shown_row(const char* heading) {
    constexpr const char* kKey = "plot-models";
    Param<S> row = text_row(
        heading, kKey,
        [](const S& s) {
            std::string names;
            for (const auto& [name, overlay] : s.plots.overlays)
                if (overlay.shown && !is_one_of(kOwnOverlays, name))
                    names += (names.empty() ? "" : ",") + name;
            return names;
        },
        [](S& s, const std::string& line) {
            for (auto& [name, overlay] : s.plots.overlays)
                if (!is_one_of(kOwnOverlays, name)) overlay.shown = false;
            std::string_view rest = line;
            while (!rest.empty()) {
                const std::size_t comma = std::min(rest.find(','), rest.size());
                const BsdfModel model = expect_model(kKey, rest.substr(0, comma));
                rest.remove_prefix(std::min(comma + 1, rest.size()));
                if (is_one_of(kOwnOverlays, model.name))
                    throw Error(ErrorCode::Usage,
                                fmt::format("{0} is shown by plot-{0}", model.name), kKey);
                s.plots.overlays[model.name].shown = true;
            }
        });
    row.info.written_unless_default = true;
    return row;
}

/// "student-t=0.4,my-model=0.2": widths of the models without keys of their own.
Param<S> widths_row(const char* heading) {
    constexpr const char* kKey = "plot-alphas";
    Param<S> row = text_row(
        heading, kKey,
        [](const S& s) {
            std::string line;
            for (const auto& [name, overlay] : s.plots.overlays)
                if (overlay.alpha != Overlay{}.alpha && !is_one_of(kOwnOverlays, name))
                    line += fmt::format("{}{}={}", line.empty() ? "" : ",", name, overlay.alpha);
            return line;
        },
        [](S& s, const std::string& line) {
            const ParamInfo info{.name = kKey, .range = kAlphaRange, .type = ParamType::Real};
            for (auto& [name, overlay] : s.plots.overlays)
                if (!is_one_of(kOwnOverlays, name)) overlay.alpha = Overlay{}.alpha;
            std::string_view rest = line;
            while (!rest.empty()) {
                const std::string_view item = rest.substr(0, rest.find(','));
                rest.remove_prefix(std::min(item.size() + 1, rest.size()));
                const std::size_t equals = std::min(item.find('='), item.size());
                const BsdfModel model = expect_model(kKey, item.substr(0, equals));
                if (is_one_of(kOwnOverlays, model.name))
                    throw Error(ErrorCode::Usage,
                                fmt::format("the width of {0} is set by {0}-alpha", model.name),
                                kKey);
                const ParamValue width =
                    parse(info, item.substr(std::min(equals + 1, item.size())));
                check(info, width);
                s.plots.overlays[model.name].alpha = std::get<double>(width);
            }
        });
    row.info.written_unless_default = true;
    return row;
}

}  // namespace

ParamTable<S> brdf_model_keys(const char* heading, const std::string& prefix,
                              BrdfSettings ModelView::*side) {
    ParamTable<S> keys = {type_row(heading, prefix + "type", side)};
    for (const char* name : kOwnKeys)
        keys.push_back(cook_torrance_row(heading, prefix + name, name, side));
    keys.push_back(further_row(heading, prefix + "models", prefix, side));
    return keys;
}

ParamTable<S> overlay_keys(const char* heading) {
    ParamTable<S> keys;
    for (const std::string name : kOwnOverlays) {
        Param<S> shown;
        shown.info = {.name = "plot-" + name, .group = heading, .type = ParamType::Flag};
        shown.get = [name](const S& s) { return s.plots.overlay(name).shown; };
        shown.set = [name](S& s, const ParamValue& v) {
            s.plots.overlays[name].shown = std::get<bool>(v);
        };
        Param<S> alpha;
        alpha.info = {.name = name + "-alpha",
                      .group = heading,
                      .range = kAlphaRange,
                      .type = ParamType::Real};
        alpha.get = [name](const S& s) { return s.plots.overlay(name).alpha; };
        alpha.set = [name](S& s, const ParamValue& v) {
            s.plots.overlays[name].alpha = std::get<double>(v);
        };
        keys.push_back(std::move(shown));
        keys.push_back(std::move(alpha));
    }
    keys.push_back(shown_row(heading));
    keys.push_back(widths_row(heading));
    Param<S> settings = text_row(
        heading, "plot-model-settings",
        [](const S& s) { return to_line(s.plots.overlay_settings); },
        [](S& s, const std::string& line) {
            s.plots.overlay_settings = from_line("plot-model-settings", line);
        });
    settings.info.written_unless_default = true;
    keys.push_back(std::move(settings));
    return keys;
}

}  // namespace asperity::studio
