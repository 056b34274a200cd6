// SPDX-License-Identifier: Apache-2.0
#include "settings_keys.h"

#include "model_keys.h"

#include <asperity/core/parse_number.h>
#include <asperity/gonio/experiment_params.h>

#include <string>
#include <vector>

namespace asperity::studio {
namespace {

using S = StudioSettings;

constexpr Names<SceneKind, 2> kScenes = {{
    {"surface", SceneKind::Surface},
    {"model", SceneKind::Model},
}};
constexpr Names<CameraType, 3> kCameras = {{
    {"orbiter", CameraType::Orbiter},
    {"first-person", CameraType::FirstPerson},
    {"6-dof", CameraType::SixDof},
}};
constexpr Names<SurfaceShading, 2> kShadings = {{
    {"normals", SurfaceShading::Normals},
    {"lit", SurfaceShading::Lit},
}};
constexpr Names<io::ColourMap, 4> kColourMaps = {{
    {"viridis", io::ColourMap::Viridis},
    {"inferno", io::ColourMap::Inferno},
    {"grey", io::ColourMap::Grey},
    {"thesis-red", io::ColourMap::ThesisRed},
}};
constexpr Names<io::Scale, 2> kScales = {{
    {"log", io::Scale::Log},
    {"linear", io::Scale::Linear},
}};
constexpr Names<io::Projection, 2> kProjections = {{
    {"sky-map", io::Projection::SkyMap},
    {"disk", io::Projection::Disk},
}};
constexpr Names<LightKind, 4> kLights = {{
    {"point", LightKind::Point},
    {"sky", LightKind::Sky},
    {"environment", LightKind::Environment},
    {"soft", LightKind::Soft},
}};
constexpr Names<ToneCurve, 3> kToneCurves = {{
    {"none", ToneCurve::None},
    {"reinhard", ToneCurve::Reinhard},
    {"aces", ToneCurve::Aces},
}};
constexpr Names<Transfer, 3> kTransfers = {{
    {"srgb", Transfer::Srgb},
    {"gamma-2.2", Transfer::Gamma22},
    {"linear", Transfer::Linear},
}};
constexpr Names<PlotKind, 5> kPlots = {{
    {"lobe-polar", PlotKind::LobePolar},
    {"lobe-cartesian", PlotKind::LobeCartesian},
    {"hemisphere", PlotKind::Hemisphere},
    {"albedo", PlotKind::Albedo},
    {"normals", PlotKind::Normals},
}};

constexpr double kMostLayers = 9000, kMostPaths = 100000, kMostChannels = 4096, kDeepest = 1000;
constexpr Range kExposureRange = {-100, 100}, kDecadesRange = {0.01, 30};
constexpr Range kElevationRange = {-90, 90}, kTurnRange = {-360, 360};

/// The way from the settings to one field: at(&S::plots, &PlotView::kind)(settings).
template <typename... Steps>
auto at(Steps... steps) {
    return [=](auto& settings) -> auto& {
        return (settings.*....*steps);
    };
}

/// Makes the rows of one group.
class Group {
  public:
    Group(ParamTable<S>& table, const char* heading) : table_(table), heading_(heading) {}

    /// A number, a flag, or the name of a file or a model, kept to the letter.
    template <typename Field>
    void value(const std::string& name, Field field, const Range& range = {}) {
        table_.push_back(field_at<S>(field, {.name = name, .group = heading_, .range = range}));
    }
    template <typename Field, typename Enum, std::size_t N>
    void choice(const char* name, Field field, const Names<Enum, N>& names) {
        table_.push_back(field_at<S>(field, names, {.name = name, .group = heading_}));
    }
    template <typename Field>
    void colour(const std::string& name, Field field) {
        three(
            name, kZeroToOne,
            [field](S& s, const std::vector<double>& c) {
                field(s) = {c[0], c[1], c[2]};
            },
            [field](const S& s) {
                const Rgb c = field(s);
                return std::vector{c.r, c.g, c.b};
            });
    }
    /// Ten numbers or none, see KeptCamera.
    template <typename Field>
    void camera(const char* name, Field field) {
        Param<S> row;
        row.info = {.name = name,
                    .group = heading_,
                    .range = kAnyNumber,
                    .absent = "home",
                    .type = ParamType::List};
        row.get = [field](const S& s) { return field(s); };
        row.set = [field, info = row.info](S& s, const ParamValue& v) {
            const auto& list = std::get<std::vector<double>>(v);
            if (!list.empty() && !camera_of(list))
                refuse(info, in_quotes(format(info, v)) + " is no camera");
            field(s) = list;
        };
        table_.push_back(std::move(row));
    }
    template <typename Field>
    void point(const char* name, Field field) {
        three(
            name, kAnyNumber,
            [field](S& s, const std::vector<double>& p) {
                field(s) = {p[0], p[1], p[2]};
            },
            [field](const S& s) {
                const Vec3 p = field(s);
                return std::vector{p.x, p.y, p.z};
            });
    }

  private:
    template <typename Set, typename Get>
    void three(const std::string& name, const Range& range, Set set, Get get) {
        Param<S> row;
        row.info = {.name = name, .group = heading_, .range = range, .type = ParamType::List};
        row.get = get;
        row.set = [set, info = row.info](S& s, const ParamValue& v) {
            const auto& list = std::get<std::vector<double>>(v);
            if (list.size() != 3)
                refuse(info, in_quotes(format(info, v)) + " is not three numbers");
            set(s, list);
        };
        table_.push_back(std::move(row));
    }

    ParamTable<S>& table_;
    const char* heading_;
};

void add_surface_scene(ParamTable<S>& keys) {
    Group group(keys, "Microfacets Surface");
    const auto of = [](auto... steps) { return at(&S::surface_view, steps...); };
    const auto of_map = [&](auto step) { return of(&SurfaceView::sky_map, step); };
    group.choice("surface-camera", of(&SurfaceView::camera_type), kCameras);
    group.camera("surface-eye", of(&SurfaceView::camera));
    group.value("current-layer", of(&SurfaceView::current_layer), {1, kMostLayers});
    group.choice("shading", of(&SurfaceView::shading), kShadings);
    group.value("whole-dome", of(&SurfaceView::whole_dome));
    group.value("lobe", of(&SurfaceView::lobe));
    group.value("model-lobes", of(&SurfaceView::model_lobes));
    group.value("dome", of(&SurfaceView::dome));
    group.value("beam", of(&SurfaceView::beam));
    group.value("paths", of(&SurfaceView::paths));
    group.value("path-count", of(&SurfaceView::path_count), {1, kMostPaths});
    group.choice("dome-colours", of_map(&io::SkyMapSettings::colour_map), kColourMaps);
    group.choice("dome-scale", of_map(&io::SkyMapSettings::scale), kScales);
    group.value("dome-decades", of_map(&io::SkyMapSettings::decades), kDecadesRange);
    group.choice("dome-projection", of_map(&io::SkyMapSettings::projection), kProjections);
    group.value("dome-legend", of_map(&io::SkyMapSettings::legend));
    group.value("dome-channel", of_map(&io::SkyMapSettings::channel), {-1, kMostChannels});
}

void add_model_scene(ParamTable<S>& keys) {
    Group group(keys, "Model");
    const auto of = [](auto... steps) { return at(&S::model_view, steps...); };
    group.choice("model-camera", of(&ModelView::camera_type), kCameras);
    group.camera("model-eye", of(&ModelView::camera));
    group.value("model", of(&ModelView::model));
    group.value("floor", of(&ModelView::floor));
    group.value("result", of(&ModelView::brdf, &BrdfSettings::result));
    group.choice("light", of(&ModelView::light), kLights);
    group.point("light-position", of(&ModelView::light_position));
    group.value("light-intensity", of(&ModelView::light_intensity), kNotNegative);
    group.value("sun-elevation", of(&ModelView::sun_elevation_deg), kElevationRange);
    group.value("sun-azimuth", of(&ModelView::sun_azimuth_deg), kTurnRange);
    group.value("environment", of(&ModelView::environment));
    group.value("environment-rotation", of(&ModelView::environment_rotation_deg), kTurnRange);
    group.value("depth", of(&ModelView::depth), {1, kDeepest});
    group.value("exposure", of(&ModelView::tone, &ToneMapping::exposure), kExposureRange);
    group.choice("tone-curve", of(&ModelView::tone, &ToneMapping::curve), kToneCurves);
    group.choice("transfer", of(&ModelView::tone, &ToneMapping::transfer), kTransfers);
    group.value("compare", of(&ModelView::compare));
    group.value("split", of(&ModelView::split), kZeroToOne);
    group.value("brdf-runs", of(&ModelView::brdf_runs));
}

void append(ParamTable<S>& keys, const ParamTable<S>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
}

/// Of the left or the right side of the comparison.
void add_brdf(ParamTable<S>& keys, const char* heading, const std::string& prefix,
              BrdfSettings ModelView::*side) {
    append(keys, brdf_model_keys(heading, prefix, side));
    Group group(keys, heading);
    const auto of = [side](auto step) { return at(&S::model_view, side, step); };
    group.value(prefix + "normalize-factor", of(&BrdfSettings::normalize_factor), kNotNegative);
    group.colour(prefix + "diffuse", of(&BrdfSettings::diffuse));
}

void add_plots(ParamTable<S>& keys) {
    Group group(keys, "Plots");
    const auto of = [](auto... steps) { return at(&S::plots, steps...); };
    group.choice("plot", of(&PlotView::kind), kPlots);
    group.choice("plot-scale", of(&PlotView::scale), kScales);
    group.value("error-band", of(&PlotView::error_band));
    group.value("follow-surface", of(&PlotView::follow_surface));
    append(keys, overlay_keys("Plots"));
}

/// Those of fit_params() with "fit-" before their names: some are names of others, too.
void add_fit(ParamTable<S>& keys) {
    ParamTable<FitSettings> rows = fit_params();
    for (Param<FitSettings>& row : rows) {
        row.info.label = label(row.info);
        row.info.name = "fit-" + row.info.name;
        row.info.written_unless_default = true;
    }
    append(keys, rows, &S::fit);
}

ParamTable<S> make_table() {
    ParamTable<S> keys;
    Group(keys, "Window").choice("scene", at(&S::scene), kScenes);
    add_surface_scene(keys);
    add_model_scene(keys);
    add_brdf(keys, "BRDF", "brdf-", &ModelView::brdf);
    add_brdf(keys, "The second BRDF of a comparison", "second-", &ModelView::second);
    Group(keys, "The second BRDF of a comparison")
        .value("second-result", at(&S::model_view, &ModelView::second, &BrdfSettings::result));
    add_plots(keys);
    add_fit(keys);
    return keys;
}

}  // namespace

const ParamTable<StudioSettings>& studio_params() {
    static const ParamTable<S> table = make_table();
    return table;
}

const ParamTable<StudioSettings>& all_params() {
    static const ParamTable<S> table = [] {
        ParamTable<S> all;
        append(all, experiment_params(), &S::experiment);
        all.insert(all.end(), studio_params().begin(), studio_params().end());
        return all;
    }();
    return table;
}

}  // namespace asperity::studio
