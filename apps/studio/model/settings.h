// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/fit/fit.h>
#include <asperity/gonio/experiment.h>
#include <asperity/pictures/pictures.h>
#include <asperity/render/camera.h>
#include <asperity/render/rgb.h>
#include <asperity/render/tonemap.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::studio {

/// The two scenes of the thesis (2.2, 2.3).
enum class SceneKind { Surface, Model };

/// Thesis table 2.1; render/camera_controller.h has what they do.
enum class CameraType { Orbiter, FirstPerson, SixDof };

/// Where a camera stood when the session was saved: position, forward, up, fov_deg; empty: where
/// cameras begin. Moving a camera changes no setting and is no step of the history.
using KeptCamera = std::vector<double>;
KeptCamera kept(const Camera& camera);
/// None unless it is one that can be looked through.
std::optional<Camera> camera_of(const KeptCamera& kept);

/// How the microfacets surface is shown.
enum class SurfaceShading {
    Normals,  ///< the thesis' look: red = |n_x|, green = |n_z|, blue = |n_y|
    Lit,      ///< as a relief lit from the side, tinted by height
};

/// The scene "Microfacets Surface".
struct SurfaceView {
    CameraType camera_type = CameraType::Orbiter;
    KeptCamera camera;
    int current_layer = 15;  ///< Current Layer: whose dome, beam and paths are shown
    SurfaceShading shading = SurfaceShading::Normals;
    bool whole_dome = false;   ///< cameras begin outside the dome, all of it in view, not within
    bool lobe = false;         ///< the layer as a solid over the surface
    bool model_lobes = false;  ///< and around it the models that the plots show, as shells
    bool dome = true;          ///< the sky-map of the current layer, around the surface
    bool beam = true;          ///< the incident beam as a wireframe (figures 2.10-2.12)
    bool paths = false;  ///< sample paths of light; those into a selected cell are shown anyway
    int path_count = 200;
    io::SkyMapSettings sky_map{io::ColourMap::ThesisRed, io::Scale::Linear};  ///< of the dome
};

/// What was set of the parameters of analytic models (bsdf/bsdf_models.h), by the model's name;
/// model_settings.h has what reads and writes it.
using ModelSettings =
    std::map<std::string, std::vector<std::pair<std::string, std::string>>, std::less<>>;

/// BRDF Type (thesis 2.3.1) and its fields.
enum class BrdfType { Model, Simulated };

struct BrdfSettings {
    BrdfType type = BrdfType::Model;
    std::string model = "cook-torrance";  ///< Model: a name in bsdf_models()
    ModelSettings settings = {{"cook-torrance", {{"roughness", "0.4"}}}};  ///< of all models
    /// Simulated: the file it is made from, a result or a BRDF in a format of formats/bsdfs; empty:
    /// the layers drawn in the other scene.
    std::string result = {};
    double normalize_factor = 1;  ///< Simulated, >= 0
    Rgb diffuse{0, 0, 0};         ///< Simulated: its Albedo, each 0 .. 1
};

enum class LightKind { Point, Sky, Environment, Soft };

/// The scene "Model".
struct ModelView {
    CameraType camera_type = CameraType::Orbiter;
    KeptCamera camera;
    std::string model;  ///< a built-in model's name or a file; empty: none loaded yet
    bool floor = false;
    bool brdf_runs = false;  ///< Start BRDF / Stop BRDF: stopped, the model is a black shape
    BrdfSettings brdf;
    bool compare = false;  ///< split view: `brdf` left of the line, `second` right of it
    BrdfSettings second{BrdfType::Simulated};
    double split = 0.5;  ///< share of the width, 0 .. 1
    LightKind light = LightKind::Point;
    Vec3 light_position{1, 1, 1};
    double light_intensity = 40;  ///< the thesis' 300 blinds a model of radius 1
    double sun_elevation_deg = 45, sun_azimuth_deg = 130;
    std::string environment;  ///< a latitude-longitude .exr or .hdr
    double environment_rotation_deg = 0;
    int depth = 1;  ///< reflections between parts of the model; 1 is the thesis' look
    ToneMapping tone = kThesisLook;
};

enum class PlotKind { LobePolar, LobeCartesian, Hemisphere, Albedo, Normals };

/// An analytic model drawn beside the simulated one.
struct Overlay {
    bool shown = false;
    double alpha = 0.3;  ///< width of its slope distribution, if the model has one
    bool operator==(const Overlay&) const = default;
};

struct PlotView {
    PlotKind kind = PlotKind::LobePolar;
    io::Scale scale = io::Scale::Linear;
    bool error_band = true;
    bool follow_surface = true;  ///< overlays take the alpha of the surface
    std::map<std::string, Overlay, std::less<>> overlays = {{"cook-torrance", {true}}};
    ModelSettings overlay_settings;  ///< but for the widths

    /// That of a model in bsdf_models().
    Overlay overlay(std::string_view model) const {
        const auto found = overlays.find(model);
        return found != overlays.end() ? found->second : Overlay{};
    }
};

/// All that a session is made of and undo can bring back.
struct StudioSettings {
    SceneKind scene = SceneKind::Surface;
    Experiment experiment;  ///< Surface, Texture and Simulation Settings
    SurfaceView surface_view;
    ModelView model_view;
    PlotView plots;
    FitSettings fit;  ///< of the dialog that fits models
};

}  // namespace asperity::studio
