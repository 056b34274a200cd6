// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/follow.h>

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>

#include <vector>

namespace asperity {

namespace {

/// The rays still under way, one weight per channel each. Compacted after every reflection.
struct Paths {
    std::vector<Ray> rays;
    std::vector<double> phi_i;
    std::vector<double> weights;  ///< [ray * channels + channel]
    std::vector<RayEnd> ends;

    void move(std::size_t from, std::size_t to, std::size_t channels) {
        if (from == to) return;
        rays[to] = rays[from];
        phi_i[to] = phi_i[from];
        for (std::size_t c = 0; c < channels; ++c)
            weights[to * channels + c] = weights[from * channels + c];
    }
};

Paths launch_paths(const LaunchBatch& batch, std::uint64_t begin, std::uint64_t end,
                   std::size_t channels) {
    Paths paths;
    const auto count = static_cast<std::size_t>(end - begin);
    paths.rays.reserve(count);
    paths.phi_i.reserve(count);
    for (std::uint64_t k = begin; k < end; ++k) {
        const Launch start = batch.launch(k);
        paths.rays.push_back(start.ray);
        paths.phi_i.push_back(start.phi_i);
    }
    paths.weights.assign(count * channels, 1.0);
    paths.ends.resize(count);
    return paths;
}

/// Mirrors the ray at the facet it stands on and lets the facet take its share.
void reflect_at_facet(const Scene& scene, Ray& ray, std::span<double> weights,
                      std::span<double> reflectance) {
    const Vec3 wm = scene.tracer.normal(ray);
    const double cos_theta = -dot(ray.direction, wm);
    ray.direction = normalize(-reflect(ray.direction, wm));
    if (scene.fresnel.perfect()) return;
    scene.fresnel.eval(std::clamp(cos_theta, 0.0, 1.0), reflectance);
    for (std::size_t c = 0; c < weights.size(); ++c) weights[c] *= reflectance[c];
}

}  // namespace

void follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin, std::uint64_t end,
            BatchSums& sums) {
    const auto channels = static_cast<std::size_t>(scene.fresnel.channels());
    std::vector<double> reflectance(channels);
    Paths paths = launch_paths(batch, begin, end, channels);
    std::size_t alive = paths.rays.size();

    for (int reflections = 0; alive > 0; ++reflections) {
        // Find the next facet of every ray, or its way out
        scene.tracer.trace(std::span(paths.rays).first(alive), std::span(paths.ends).first(alive));
        sums.segments += alive;

        std::size_t kept = 0;
        for (std::size_t k = 0; k < alive; ++k) {
            Ray& ray = paths.rays[k];
            const std::span<double> weights(&paths.weights[k * channels], channels);
            switch (paths.ends[k]) {
                case RayEnd::Hit:
                    // The bounce limit cuts a ray that would need one reflection more
                    if (reflections == scene.bounces) {
                        sums.truncate(weights);
                        break;
                    }
                    reflect_at_facet(scene, ray, weights, reflectance);
                    ++sums.reflections;
                    paths.move(k, kept++, channels);
                    break;
                case RayEnd::Escaped: {
                    // Sort by direction; order 1 left after one reflection
                    const Vec3 wo = scene.relative_azimuth
                                        ? rotate_z(ray.direction, -paths.phi_i[k])
                                        : ray.direction;
                    sums.escape(scene.detector.cell_of(wo), reflections, weights);
                    break;
                }
                case RayEnd::Edge:
                    sums.lose_at_edge(weights);
                    break;
                case RayEnd::Stuck:
                    sums.truncate(weights);
                    ++sums.stuck;
                    break;
            }
        }
        alive = kept;
    }
    sums.rays += end - begin;
}

}  // namespace asperity
