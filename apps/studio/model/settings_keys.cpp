// SPDX-License-Identifier: Apache-2.0
#include "settings_keys.h"

#include <algorithm>
#include <vector>

namespace asperity::studio {
namespace {

using S = StudioSettings;
using V = io::SettingValue;

constexpr io::Names<SceneKind, 2> kScenes = {{
    {"surface", SceneKind::Surface},
    {"model", SceneKind::Model},
}};
constexpr io::Names<CameraType, 3> kCameras = {{
    {"orbiter", CameraType::Orbiter},
    {"first-person", CameraType::FirstPerson},
    {"6-dof", CameraType::SixDof},
}};
constexpr io::Names<SurfaceShading, 2> kShadings = {{
    {"normals", SurfaceShading::Normals},
    {"lit", SurfaceShading::Lit},
}};
constexpr io::Names<io::ColourMap, 4> kColourMaps = {{
    {"viridis", io::ColourMap::Viridis},
    {"inferno", io::ColourMap::Inferno},
    {"grey", io::ColourMap::Grey},
    {"thesis-red", io::ColourMap::ThesisRed},
}};
constexpr io::Names<io::Scale, 2> kScales = {{
    {"log", io::Scale::Log},
    {"linear", io::Scale::Linear},
}};
constexpr io::Names<io::Projection, 2> kProjections = {{
    {"sky-map", io::Projection::SkyMap},
    {"disk", io::Projection::Disk},
}};
constexpr io::Names<BrdfType, 2> kBrdfTypes = {{
    {"cook-torrance", BrdfType::CookTorrance},
    {"simulated", BrdfType::Simulated},
}};
constexpr io::Names<LightKind, 3> kLights = {{
    {"point", LightKind::Point},
    {"sky", LightKind::Sky},
    {"environment", LightKind::Environment},
}};
constexpr io::Names<ToneCurve, 3> kToneCurves = {{
    {"none", ToneCurve::None},
    {"reinhard", ToneCurve::Reinhard},
    {"aces", ToneCurve::Aces},
}};
constexpr io::Names<Transfer, 3> kTransfers = {{
    {"srgb", Transfer::Srgb},
    {"gamma-2.2", Transfer::Gamma22},
    {"linear", Transfer::Linear},
}};
constexpr io::Names<PlotKind, 5> kPlots = {{
    {"lobe-polar", PlotKind::LobePolar},
    {"lobe-cartesian", PlotKind::LobeCartesian},
    {"hemisphere", PlotKind::Hemisphere},
    {"albedo", PlotKind::Albedo},
    {"normals", PlotKind::Normals},
}};

/// The way from the settings to one field: at(&S::plots, &PlotView::kind)(settings).
template <typename... Steps>
auto at(Steps... steps) {
    return [=](auto& settings) -> auto& {
        return (settings.*....*steps);
    };
}

/// Makes the keys of one group.
class Group {
  public:
    Group(std::vector<StudioKey>& keys, const char* heading) : keys_(keys), heading_(heading) {}

    template <typename Field>
    void flag(const char* name, Field field) {
        add(
            name, [field](S& s, const V& v) { field(s) = v.flag(); },
            [field](const S& s) { return std::string(field(s) ? "true" : "false"); });
    }
    template <typename Field>
    void integer(const char* name, Field field, int low, int high) {
        add(
            name, [=](S& s, const V& v) { field(s) = v.integer(low, high); },
            [field](const S& s) { return std::to_string(field(s)); });
    }
    template <typename Field>
    void number(const char* name, Field field, const io::Range& range) {
        add(
            name, [field, range](S& s, const V& v) { field(s) = v.number(range); },
            [field](const S& s) { return shortest(field(s)); });
    }
    template <typename Field, typename Enum, std::size_t N>
    void choice(const char* name, Field field, const io::Names<Enum, N>& names) {
        add(
            name, [field, &names](S& s, const V& v) { field(s) = v.choice(names); },
            [field, &names](const S& s) { return io::text_of(names, field(s)); });
    }
    /// A name of a file or a model, kept to the letter; may be empty.
    template <typename Field>
    void name(const char* name, Field field) {
        add(
            name, [field](S& s, const V& v) { field(s) = std::string(v.raw()); },
            [field](const S& s) { return field(s); });
    }
    template <typename Field>
    void colour(const char* name, Field field) {
        add(
            name,
            [field](S& s, const V& v) {
                const std::array c = three(v, io::kZeroToOne);
                field(s) = {c[0], c[1], c[2]};
            },
            [field](const S& s) {
                const Rgb c = field(s);
                return io::text_of(std::vector{c.r, c.g, c.b});
            });
    }
    template <typename Field>
    void point(const char* name, Field field) {
        add(
            name,
            [field](S& s, const V& v) {
                const std::array p = three(v, io::kAnyNumber);
                field(s) = {p[0], p[1], p[2]};
            },
            [field](const S& s) {
                const Vec3 p = field(s);
                return io::text_of(std::vector{p.x, p.y, p.z});
            });
    }

  private:
    static std::array<double, 3> three(const V& value, const io::Range& range) {
        const std::vector<double> list = value.list(range);
        if (list.size() != 3) value.refuse(in_quotes(value.text()) + " is not three numbers");
        return {list[0], list[1], list[2]};
    }
    template <typename Set, typename Get>
    void add(const char* name, Set set, Get get) {
        keys_.push_back({name, heading_, std::move(set), std::move(get)});
    }

    std::vector<StudioKey>& keys_;
    const char* heading_;
};

void add_surface_scene(std::vector<StudioKey>& keys) {
    Group group(keys, "Microfacets Surface");
    const auto of = [](auto... steps) { return at(&S::surface_view, steps...); };
    const auto of_map = [&](auto step) { return of(&SurfaceView::sky_map, step); };
    group.choice("surface-camera", of(&SurfaceView::camera_type), kCameras);
    group.integer("current-layer", of(&SurfaceView::current_layer), 1, kMostLayers);
    group.choice("shading", of(&SurfaceView::shading), kShadings);
    group.flag("dome", of(&SurfaceView::dome));
    group.flag("beam", of(&SurfaceView::beam));
    group.flag("paths", of(&SurfaceView::paths));
    group.integer("path-count", of(&SurfaceView::path_count), 1, kMostPaths);
    group.choice("dome-colours", of_map(&io::SkyMapSettings::colour_map), kColourMaps);
    group.choice("dome-scale", of_map(&io::SkyMapSettings::scale), kScales);
    group.number("dome-decades", of_map(&io::SkyMapSettings::decades), kDecadesRange);
    group.choice("dome-projection", of_map(&io::SkyMapSettings::projection), kProjections);
    group.flag("dome-legend", of_map(&io::SkyMapSettings::legend));
    group.integer("dome-channel", of_map(&io::SkyMapSettings::channel), -1, kMostChannels);
}

void add_model_scene(std::vector<StudioKey>& keys) {
    Group group(keys, "Model");
    const auto of = [](auto... steps) { return at(&S::model_view, steps...); };
    group.choice("model-camera", of(&ModelView::camera_type), kCameras);
    group.name("model", of(&ModelView::model));
    group.flag("floor", of(&ModelView::floor));
    group.name("result", of(&ModelView::result));
    group.choice("light", of(&ModelView::light), kLights);
    group.point("light-position", of(&ModelView::light_position));
    group.number("light-intensity", of(&ModelView::light_intensity), io::kNotNegative);
    group.number("sun-elevation", of(&ModelView::sun_elevation_deg), kElevationRange);
    group.number("sun-azimuth", of(&ModelView::sun_azimuth_deg), kTurnRange);
    group.name("environment", of(&ModelView::environment));
    group.number("environment-rotation", of(&ModelView::environment_rotation_deg), kTurnRange);
    group.integer("depth", of(&ModelView::depth), 1, kDeepest);
    group.number("exposure", of(&ModelView::tone, &ToneMapping::exposure), kExposureRange);
    group.choice("tone-curve", of(&ModelView::tone, &ToneMapping::curve), kToneCurves);
    group.choice("transfer", of(&ModelView::tone, &ToneMapping::transfer), kTransfers);
    group.flag("compare", of(&ModelView::compare));
    group.number("split", of(&ModelView::split), io::kZeroToOne);
    group.flag("brdf-runs", of(&ModelView::brdf_runs));
}

/// `names` in the order of the fields, for the left and the right side of the comparison.
void add_brdf(std::vector<StudioKey>& keys, const char* heading, BrdfSettings ModelView::*side,
              const std::array<const char*, 6>& names) {
    Group group(keys, heading);
    const auto of = [side](auto step) { return at(&S::model_view, side, step); };
    group.choice(names[0], of(&BrdfSettings::type), kBrdfTypes);
    group.number(names[1], of(&BrdfSettings::metallic), io::kZeroToOne);
    group.number(names[2], of(&BrdfSettings::roughness), io::kZeroToOne);
    group.colour(names[3], of(&BrdfSettings::albedo));
    group.number(names[4], of(&BrdfSettings::normalize_factor), io::kNotNegative);
    group.colour(names[5], of(&BrdfSettings::diffuse));
}

void add_plots(std::vector<StudioKey>& keys) {
    Group group(keys, "Plots");
    const auto of = [](auto... steps) { return at(&S::plots, steps...); };
    group.choice("plot", of(&PlotView::kind), kPlots);
    group.choice("plot-scale", of(&PlotView::scale), kScales);
    group.flag("error-band", of(&PlotView::error_band));
    group.flag("follow-surface", of(&PlotView::follow_surface));
    group.flag("plot-cook-torrance", of(&PlotView::cook_torrance, &Overlay::shown));
    group.number("cook-torrance-alpha", of(&PlotView::cook_torrance, &Overlay::alpha), kAlphaRange);
    group.flag("plot-ggx", of(&PlotView::ggx, &Overlay::shown));
    group.number("ggx-alpha", of(&PlotView::ggx, &Overlay::alpha), kAlphaRange);
    group.flag("plot-beckmann", of(&PlotView::beckmann, &Overlay::shown));
    group.number("beckmann-alpha", of(&PlotView::beckmann, &Overlay::alpha), kAlphaRange);
}

std::vector<StudioKey> make_keys() {
    std::vector<StudioKey> keys;
    Group(keys, "Window").choice("scene", at(&S::scene), kScenes);
    add_surface_scene(keys);
    add_model_scene(keys);
    add_brdf(keys, "BRDF", &ModelView::brdf,
             {"brdf-type", "brdf-metallic", "brdf-roughness", "brdf-albedo",
              "brdf-normalize-factor", "brdf-diffuse"});
    add_brdf(keys, "The second BRDF of a comparison", &ModelView::second,
             {"second-type", "second-metallic", "second-roughness", "second-albedo",
              "second-normalize-factor", "second-diffuse"});
    add_plots(keys);
    return keys;
}

}  // namespace

std::span<const StudioKey> studio_keys() {
    static const std::vector<StudioKey> keys = make_keys();
    return keys;
}

const StudioKey* find_studio_key(std::string_view name) {
    const auto keys = studio_keys();
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.name == name; });
    return found == keys.end() ? nullptr : &*found;
}

}  // namespace asperity::studio
