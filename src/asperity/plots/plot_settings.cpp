// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_settings.h>

#include <asperity/params/fields.h>
#include <asperity/plots/plot_kinds.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::plots {

namespace {

constexpr Names<PlotAxes, 2> kAxes = {
    {{"polar", PlotAxes::Polar}, {"cartesian", PlotAxes::Cartesian}}};
constexpr Names<PlotScale, 3> kScales = {
    {{"auto", PlotScale::Auto}, {"linear", PlotScale::Linear}, {"log", PlotScale::Log}}};
constexpr Names<ProfileLine, 2> kLines = {{{"x", ProfileLine::X}, {"y", ProfileLine::Y}}};
constexpr Names<io::ColourMap, 4> kColourMaps = {{{"viridis", io::ColourMap::Viridis},
                                                  {"inferno", io::ColourMap::Inferno},
                                                  {"grey", io::ColourMap::Grey},
                                                  {"thesis-red", io::ColourMap::ThesisRed}}};

/// The kinds that use a setting, "lobe, albedo"; empty: all.
std::string users_of(const std::string& setting) {
    std::vector<std::string> users;
    for (const PlotKind& kind : plot_kinds())
        if (uses(kind, setting)) users.push_back(kind.name);
    return users.size() == plot_kinds().size() ? "" : fmt::format("{}", fmt::join(users, ", "));
}

Param<PlotSettings> kind_row() {
    Param<PlotSettings> row = field(&PlotSettings::kind, {.name = "kind"});
    row.info.type = ParamType::Choice;
    std::string doc = "what is plotted:";
    for (const PlotKind& kind : plot_kinds()) {
        row.info.choices.push_back(kind.name);
        doc += (kind.name == plot_kinds().front().name ? " " : "; ") + kind.name + ", " + kind.doc;
    }
    row.info.doc = doc;
    return row;
}

ParamTable<PlotSettings> rows() {
    using S = PlotSettings;
    return {
        kind_row(),
        field(&S::axes, kAxes,
              {.name = "axes", .doc = "angles around a half disc, or along a straight axis"}),
        field(&S::scale, kScales,
              {.name = "scale",
               .doc = "of the values; auto: log for hemisphere and psd, else linear"}),
        field(&S::decades, {.name = "decades",
                            .range = {0, 30, true},
                            .doc = "decades of a log scale, below its upper end"}),
        field(&S::theta, {.name = "theta",
                          .metavar = "D[,D...]",
                          .unit = "degrees",
                          .range = kBelowHorizon,
                          .doc = "angles of incidence; a result has those of its layers",
                          .otherwise = "that nearest to 45"}),
        field(&S::layer, {.name = "layer",
                          .metavar = "N[,N...]",
                          .range = {1, 1e6},
                          .doc = "layers of the results by number, in place of --theta",
                          .otherwise = "by --theta"}),
        field(&S::phi, {.name = "phi",
                        .unit = "degrees",
                        .range = {-360, 360},
                        .doc = "azimuth the light comes from"}),
        field(&S::plane,
              {.name = "plane",
               .unit = "degrees",
               .range = {-180, 180},
               .doc = "azimuth of the plane the lobe is cut in, from the plane of incidence"}),
        field(&S::average,
              {.name = "average",
               .range = {0, 64},
               .absent = "auto",
               .doc = "cells are averaged over so many columns of the detector to either side; "
                      "auto: over more where noise asks for it, and the plot says so"}),
        field(&S::no_errors,
              {.name = "no-errors", .doc = "without the bands of one standard error"}),
        field(&S::channel, {.name = "channel",
                            .absent = "mean",
                            .doc = "one channel, by name or number from 0",
                            .otherwise = "mean of all"}),
        field(&S::colour_map, kColourMaps, {.name = "colour-map", .doc = "colours of values"}),
        field(&S::camera_azimuth, {.name = "camera-azimuth",
                                   .unit = "degrees",
                                   .range = {-360, 360},
                                   .doc = "azimuth the solid is seen from"}),
        field(&S::camera_elevation, {.name = "camera-elevation",
                                     .unit = "degrees",
                                     .range = {0, 90},
                                     .doc = "angle above the surface it is seen from"}),
        field(&S::line, kLines, {.name = "along", .doc = "direction of the line"}),
        field(&S::line_at,
              {.name = "at",
               .range = kZeroToOne,
               .doc = "where the line lies: 0 at the first row or column, 1 at the last"}),
        field(&S::title, {.name = "title",
                          .absent = "none",
                          .doc = "above all",
                          .otherwise = "made from the data"}),
    };
}

}  // namespace

ParamTable<PlotSettings> plot_params() {
    ParamTable<PlotSettings> table = rows();
    for (Param<PlotSettings>& row : table) {
        const std::string name = row.info.name;
        row.info.group = "Plots (asperity plot)";
        row.info.users = users_of(name);
        row.unused = [name](const PlotSettings& settings) -> std::string {
            const PlotKind* kind = find_plot_kind(settings.kind);
            if (kind == nullptr) return {};
            if (!uses(*kind, name)) return "has no effect on --kind " + settings.kind;
            const bool log = settings.scale == PlotScale::Auto ? kind->usually_log
                                                               : settings.scale == PlotScale::Log;
            return name == "decades" && !log ? "it is of a log scale" : "";
        };
    }
    return table;
}

void check(const PlotSettings& settings) {
    check_all(plot_params(), settings);
    if (find_plot_kind(settings.kind) == nullptr) parse(kind_row().info, settings.kind);
    if (!settings.theta.empty() && !settings.layer.empty())
        throw Error(ErrorCode::Usage, "layers are chosen by number or by --theta, not both",
                    "layer");
    for (const double number : settings.layer)
        if (number != std::floor(number))
            throw Error(ErrorCode::Usage, fmt::format("{} is no whole number", number), "layer");
}

}  // namespace asperity::plots
