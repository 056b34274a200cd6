// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/light_choice.h>
#include <asperity/render/renderer.h>
#include <asperity/render/sampler.h>
#include <asperity/render/shading.h>

#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

/// What all paths of a picture share.
struct View {
    const ModelScene& scene;
    const RenderSettings& settings;
    const LightChoice& lights;
    PixelRays rays;
};

/// One sample of one pixel on its way.
struct Path {
    WorldRay ray;  ///< the next to be followed
    PixelSampler sampler;
    const Material* subject;  ///< the one assigned to Role::Subject
    Rgb radiance;             ///< found so far
    Rgb throughput{1, 1, 1};  ///< of what `ray` will bring
    double pdf = 0;           ///< of ray.direction, as the BRDF draws it [1/sr]
};

/// A point that a path came to.
struct Vertex {
    SurfacePoint point;
    ShadingFrame frame;
    Vec3 view;  ///< where the path came from, in the frame
    const Material* material = nullptr;

    WorldRay ray_to(Vec3 direction) const {
        return {point.position + point.offset * point.geometric_normal, direction};
    }
    /// What the cosine and the seam of smooth normals leave of light from `direction`, which is
    /// `local` in the frame; 0 where it cannot come from.
    double cosine(Vec3 direction, Vec3 local) const {
        if (local.z <= 0 || !lit_from(point, direction)) return 0;
        return local.z * terminator_softness(point, direction);
    }
};

/// The paths of a tile, in step, so that rays that run together can be traced together. The
/// integrators are made of its members.
class Wave {
  public:
    Wave(const View& view, std::vector<Path>& paths, RayCounts& counts);

    const View& view() const { return view_; }
    std::vector<Path>& paths() { return paths_; }

    /// Where the camera's rays end.
    std::vector<Hit> camera_hits();
    /// Where a ray ends that left a surface.
    Hit next_hit(const WorldRay& ray);

    Vertex vertex(const Path& path, const Hit& hit) const;
    /// What the camera sees beside the model.
    Rgb background(Vec3 direction) const;

    /// Asks lights for a sample each, to be added to the path unless something hides it.
    /// `from_camera`: the vertex is the first.
    void ask_lights(std::size_t path, const Vertex& vertex, bool from_camera);
    /// Adds `radiance` to the path unless something lies on the ray.
    void add_unless_hidden(std::size_t path, const WorldRay& ray, Rgb radiance);
    /// Traces all that was asked for.
    void trace_shadow_rays();

  private:
    struct Shadows {
        std::vector<WorldRay> rays;
        std::vector<double> distances;
        std::vector<Rgb> radiances;
        std::vector<std::size_t> paths;

        void add(std::size_t path, const WorldRay& ray, double distance, Rgb radiance);
        void clear();
    };
    void ask(const LightChoice::Chance& chance, std::size_t path, const Vertex& vertex,
             Shadows& shadows);

    const View& view_;
    std::vector<Path>& paths_;
    RayCounts& counts_;
    Shadows together_, scattered_;  ///< rays to a point or in parallel, and all others
    std::vector<std::uint8_t> hidden_;
};

/// Follows the paths as Integrator::Path says: their radiance is found.
void trace_paths(Wave& wave);

/// Integrator::Stratified, for sample `sample` of each pixel; the paths' pixels are `pixels`.
void trace_strata(Wave& wave, std::span<const std::uint32_t> pixels, std::uint32_t sample);

}  // namespace asperity
