// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/renderer.h>

#include <memory>
#include <string>

namespace asperity::bench {

/// What the renderer's benchmarks show: a built-in model seen from the front, slightly above.
struct RenderBench {
    Model model;
    std::shared_ptr<const TracedModel> traced;
    Camera camera = look_at({0.8, 0.8, 2.6}, {0, 0, 0}, 45);

    explicit RenderBench(const std::string& name);
    ModelScene scene(Material material, bool sky) const;
};

/// The thesis' point light, in its place.
inline constexpr PointLightSettings kBenchLamp{};

/// A table of a Gaussian surface, alpha 0.424, as `asperity run` makes it: the simulated BRDF.
std::shared_ptr<const Bsdf> measured_brdf();
/// The same, as the renderer wears it.
std::shared_ptr<const Bsdf> simulated_brdf(const Bsdf& measured);

/// Processor time of rendering `passes` samples per pixel on the calling thread [s].
double frame_seconds(const ModelScene& scene, const Camera& camera, const RenderSettings& settings,
                     std::uint32_t passes, RayCounts* counts = nullptr);

}  // namespace asperity::bench
