// SPDX-License-Identifier: Apache-2.0
#include "first_session.h"

#include "model_settings.h"

#include <asperity/optics/fresnel.h>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace asperity::studio {
namespace {

void set_experiment(Experiment& e) {
    e.surface.kind = "gaussian";
    e.surface.size = 256;
    e.surface.alpha_x = e.surface.alpha_y = 0.2;
    e.surface.correlation_x = e.surface.correlation_y = 12;
    e.optics.fresnel = FresnelKind::Conductor;
    e.optics.material = "Au";
    // The surface looks alike from everywhere; so does its BRDF then, and far less noisy
    e.illumination.isotropic = true;
    e.detector.resolution = 128;
    e.run.jitter = 32;
}

void set_surface_view(SurfaceView& view) {
    view.current_layer = 8;  // light from 42 degrees
    view.shading = SurfaceShading::Lit;
    view.lobe = view.whole_dome = true;
    view.sky_map.colour_map = io::ColourMap::Viridis;
    view.sky_map.scale = io::Scale::Linear;
}

/// Cook-Torrance for the same metal and slopes: its reflectance along the normal, alpha =
/// roughness^2.
ModelSettings cook_torrance_of(const Experiment& experiment) {
    std::array<double, 3> f{};
    Fresnel(experiment.optics).eval(1, f);
    return from_line(
        "second-settings",
        fmt::format("cook-torrance:roughness={:.2f},metallic=1,albedo={:.3f}/{:.3f}/{:.3f}",
                    std::sqrt(experiment.surface.alpha_x), f[0], f[1], f[2]));
}

void set_model_view(ModelView& view, const Experiment& experiment) {
    view.brdf_runs = true;
    view.brdf.type = BrdfType::Simulated;
    view.second.type = BrdfType::Model;
    for (BrdfSettings* side : {&view.brdf, &view.second}) {
        side->model = "cook-torrance";
        side->settings = cook_torrance_of(experiment);
    }
    view.light = LightKind::Soft;
    view.floor = true;
    view.depth = 2;
    view.tone = {0, ToneCurve::Aces, Transfer::Srgb};
}

}  // namespace

StudioSettings first_session() {
    StudioSettings settings;
    set_experiment(settings.experiment);
    set_surface_view(settings.surface_view);
    set_model_view(settings.model_view, settings.experiment);
    return settings;
}

}  // namespace asperity::studio
