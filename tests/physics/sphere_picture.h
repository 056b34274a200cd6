// SPDX-License-Identifier: Apache-2.0
#pragma once

// Pictures of one fine sphere, for the physics tests of the renderer.

#include <asperity/render/builtin_models.h>
#include <asperity/render/renderer.h>

#include <gtest/gtest.h>

#include <memory>
#include <optional>

namespace asperity::test {

/// Traced once: a million triangles, 0.35 degrees wide.
inline std::shared_ptr<const TracedModel> fine_sphere() {
    static const std::shared_ptr<const TracedModel> sphere = [] {
        Model model;
        model.name = "sphere";
        model.meshes.push_back(make_sphere(1024, 512));
        model.instances.push_back({});
        asperity::Run run(0);
        return std::make_shared<const TracedModel>(model, run);
    }();
    return sphere;
}

inline ModelScene sphere_scene(Material material,
                               std::vector<std::shared_ptr<const Light>> lights) {
    const Material stage = material;
    return {fine_sphere(), std::move(material), {}, stage, std::move(lights)};
}

/// From z = 6: the sphere fills the height of the picture nearly.
inline Camera sphere_camera() {
    return look_at({0, 0, 6}, {0, 0, 0}, 19.5);
}

/// A picture whose samples all lie in the middle of their pixels, direct light only.
inline RenderSettings plain_picture(int side, std::uint32_t spp) {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.spp = spp;
    settings.depth = 1;
    settings.filter = PixelFilter::Centre;
    return settings;
}

/// Renders, and expects that nothing went wrong on the way.
inline Film picture(const ModelScene& scene, const RenderSettings& settings,
                    const Camera& camera = sphere_camera()) {
    Renderer renderer(scene, camera, settings);
    asperity::Run run(0);
    render(renderer, run);
    EXPECT_EQ(renderer.rays().invalid, 0u);
    return renderer.film();
}

/// Where the middle of a pixel meets the true sphere: also its normal; none beside it.
struct SpherePoint {
    Vec3 normal, view;
};
inline std::optional<SpherePoint> sphere_point(const RenderSettings& settings, int x, int y,
                                               const Camera& camera = sphere_camera()) {
    const WorldRay ray = PixelRays(camera, settings.width, settings.height).at(x + 0.5, y + 0.5);
    const double b = dot(ray.origin, ray.direction);
    const double root = b * b - dot(ray.origin, ray.origin) + 1;
    if (root <= 0) return std::nullopt;
    return SpherePoint{ray.origin + (-b - std::sqrt(root)) * ray.direction, -ray.direction};
}

}  // namespace asperity::test
