// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/wave.h>

#include <limits>

namespace asperity {

void Wave::Shadows::add(std::size_t path, const WorldRay& ray, double distance, Rgb radiance) {
    rays.push_back(ray);
    distances.push_back(distance);
    radiances.push_back(radiance);
    paths.push_back(path);
}

void Wave::Shadows::clear() {
    rays.clear();
    distances.clear();
    radiances.clear();
    paths.clear();
}

Wave::Wave(const View& view, std::vector<Path>& paths, RayCounts& counts)
    : view_(view), paths_(paths), counts_(counts) {}

std::vector<Hit> Wave::camera_hits() {
    std::vector<WorldRay> rays;
    rays.reserve(paths_.size());
    for (const Path& path : paths_) rays.push_back(path.ray);
    std::vector<Hit> hits(rays.size());
    view_.scene.model->intersect(rays, hits);
    counts_.primary += rays.size();
    return hits;
}

Hit Wave::next_hit(const WorldRay& ray) {
    ++counts_.bounce;
    return view_.scene.model->intersect(ray);
}

Vertex Wave::vertex(const Path& path, const Hit& hit) const {
    Vertex vertex;
    vertex.point = view_.scene.model->surface(path.ray, hit);
    const Vec3 to_viewer = -path.ray.direction;
    vertex.frame = shading_frame(vertex.point, to_viewer);
    vertex.view = vertex.frame.to_local(to_viewer);
    vertex.material = vertex.point.role == Role::Stage ? &view_.scene.stage : path.subject;
    return vertex;
}

Rgb Wave::background(Vec3 direction) const {
    if (!view_.settings.show_lights) return view_.settings.background;
    Rgb sum;
    for (const auto& light : view_.scene.lights) sum = sum + light->background(direction);
    return sum;
}

void Wave::ask_lights(std::size_t path, const Vertex& vertex, bool from_camera) {
    const double u = view_.lights.chooses() ? paths_[path].sampler.next2()[0] : 0;
    for (const LightChoice::Chance& chance : view_.lights.choose(u)) {
        const bool run_together = from_camera && chance.light->is_delta();
        ask(chance, path, vertex, run_together ? together_ : scattered_);
    }
}

void Wave::ask(const LightChoice::Chance& chance, std::size_t k, const Vertex& vertex,
               Shadows& shadows) {
    Path& path = paths_[k];
    const auto u = path.sampler.next2();
    const auto light = chance.light->sample(vertex.point.position, u[0], u[1]);
    if (!light || is_black(light->radiance)) return;
    const Vec3 local = vertex.frame.to_local(light->direction);
    const double cosine = vertex.cosine(light->direction, local);
    if (cosine <= 0) return;

    // The balance heuristic: what the BRDF would have found, it finds less of
    double density = chance.share * light->pdf;
    Rgb f;
    if (view_.settings.direct == DirectLight::Mis && !chance.light->is_delta()) {
        double pdf = 0;
        f = vertex.material->eval_pdf(vertex.view, local, pdf);
        density += pdf;
    } else {
        f = vertex.material->eval(vertex.view, local);
    }
    const Rgb radiance = (cosine / density) * (path.throughput * f * light->radiance);
    if (is_black(radiance)) return;
    shadows.add(k, vertex.ray_to(light->direction), light->distance, radiance);
}

void Wave::add_unless_hidden(std::size_t path, const WorldRay& ray, Rgb radiance) {
    scattered_.add(path, ray, std::numeric_limits<double>::infinity(), radiance);
}

void Wave::trace_shadow_rays() {
    const TracedModel& model = *view_.scene.model;
    hidden_.resize(together_.rays.size());
    model.occluded(together_.rays, together_.distances, hidden_);
    for (std::size_t k = 0; k < hidden_.size(); ++k) {
        Path& path = paths_[together_.paths[k]];
        if (hidden_[k] == 0) path.radiance = path.radiance + together_.radiances[k];
    }
    for (std::size_t k = 0; k < scattered_.rays.size(); ++k) {
        if (model.occluded(scattered_.rays[k], scattered_.distances[k])) continue;
        Path& path = paths_[scattered_.paths[k]];
        path.radiance = path.radiance + scattered_.radiances[k];
    }
    counts_.shadow += together_.rays.size() + scattered_.rays.size();
    together_.clear();
    scattered_.clear();
}

}  // namespace asperity
