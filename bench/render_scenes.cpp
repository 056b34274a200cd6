// SPDX-License-Identifier: Apache-2.0
#include "render_scenes.h"

#include "clocks.h"
#include "surfaces.h"

#include <asperity/gonio/measure.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/tabulated.h>
#include <asperity/render/builtin_models.h>
#include <asperity/render/sky.h>
#include <asperity/surface/make_surface.h>

#include <utility>

namespace asperity::bench {

RenderBench::RenderBench(const std::string& name) : model(make_builtin_model(name)) {
    Run run;
    traced = std::make_shared<TracedModel>(model, run);
}

ModelScene RenderBench::scene(Material material, bool sky) const {
    const Material stage = material;
    ModelScene scene{traced, std::move(material), {}, stage, {}};
    if (sky) {
        for (auto& light : make_sky({})) scene.lights.push_back(std::move(light));
    } else {
        scene.lights.push_back(make_light(kBenchLamp));
    }
    return scene;
}

std::shared_ptr<const Bsdf> measured_brdf() {
    Run run;
    Experiment e;
    e.illumination.isotropic = true;
    e.illumination.theta_deg = {0, 10, 20, 30, 40, 50, 60, 70, 80, 86};
    e.detector.resolution = 90;
    e.run.rays = 200000;
    const Heightfield surface = make_surface(surface_settings("gaussian-0.3", 512), run);
    return make_tabulated_brdf(measure(surface, e, run));
}

std::shared_ptr<const Bsdf> simulated_brdf(const Bsdf& measured) {
    Run run;
    return bake_brdf(measured, run);
}

double frame_seconds(const ModelScene& scene, const Camera& camera, const RenderSettings& settings,
                     std::uint32_t passes, RayCounts* counts) {
    Renderer renderer(scene, camera, settings);
    Run run(1);
    run.begin("rendering", 1);
    const double begin = cpu_seconds();
    for (std::uint32_t pass = 0; pass < passes; ++pass) renderer.render_pass(run);
    const double seconds = cpu_seconds() - begin;
    if (counts != nullptr) *counts = renderer.rays();
    return seconds;
}

}  // namespace asperity::bench
