// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/wave.h>

#include <algorithm>

namespace asperity {

namespace {

/// Reflections after which a path may end by chance.
constexpr int kSureReflections = 4;

bool brdf_finds_light(const View& view) {
    return view.settings.direct != DirectLight::LightOnly && !view.lights.extended().empty();
}

/// Light of those with an extent from where the BRDF drew `direction` with density `pdf`, weighted
/// with what asking the lights would have found of it.
Rgb light_found(const View& view, Vec3 direction, double pdf) {
    Rgb sum;
    if (!brdf_finds_light(view)) return sum;
    for (const LightChoice::Chance& chance : view.lights.extended()) {
        // share is 0, and so is the other density, when only the BRDF looks for light
        const double other = chance.share > 0 ? chance.share * chance.light->pdf(direction) : 0.0;
        sum = sum + (pdf / (pdf + other)) * chance.light->radiance(direction);
    }
    return sum;
}

/// Ends some of the paths that carry little; the others carry on for them.
bool survives(Path& path) {
    const Rgb t = path.throughput;
    const double chance = std::min(0.95, std::max({t.r, t.g, t.b}));
    if (path.sampler.next2()[0] >= chance) return false;
    path.throughput = (1 / chance) * t;
    return true;
}

/// Draws where the path goes on from a vertex; false when it ends there.
bool turn(Path& path, const Vertex& vertex) {
    const auto u = path.sampler.next2();
    const auto drawn = vertex.material->sample(vertex.view, u[0], u[1]);
    if (!drawn) return false;
    const Vec3 direction = vertex.frame.to_world(drawn->light);
    const double cosine = vertex.cosine(direction, drawn->light);
    path.throughput = (cosine / drawn->pdf) * (path.throughput * drawn->f);
    path.ray = vertex.ray_to(direction);
    path.pdf = drawn->pdf;
    return !is_black(path.throughput);
}

}  // namespace

void trace_paths(Wave& wave) {
    const View& view = wave.view();
    std::vector<Path>& paths = wave.paths();
    std::vector<Hit> hits = wave.camera_hits();
    std::vector<std::size_t> here(paths.size()), next;
    for (std::size_t k = 0; k < here.size(); ++k) here[k] = k;

    for (int reflection = 1; !here.empty(); ++reflection) {
        next.clear();
        for (const std::size_t k : here) {
            Path& path = paths[k];
            // Leave the scene
            if (!hits[k].found()) {
                const Rgb seen = reflection == 1 ? wave.background(path.ray.direction)
                                                 : light_found(view, path.ray.direction, path.pdf);
                path.radiance = path.radiance + path.throughput * seen;
                continue;
            }
            // Look for light
            const Vertex vertex = wave.vertex(path, hits[k]);
            wave.ask_lights(k, vertex, reflection == 1);
            // Go on; after the last reflection there may only be light
            const bool last = reflection == view.settings.depth;
            if ((last && !brdf_finds_light(view)) || !turn(path, vertex)) continue;
            if (last) {
                const Rgb found = path.throughput * light_found(view, path.ray.direction, path.pdf);
                if (!is_black(found)) wave.add_unless_hidden(k, path.ray, found);
            } else if (reflection < kSureReflections || survives(path)) {
                next.push_back(k);
            }
        }
        wave.trace_shadow_rays();
        for (const std::size_t k : next) hits[k] = wave.next_hit(paths[k].ray);
        here.swap(next);
    }
}

}  // namespace asperity
