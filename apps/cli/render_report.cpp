// SPDX-License-Identifier: Apache-2.0
#include "render_report.h"

#include "progress.h"

#include <asperity/core/version.h>

#include <fmt/format.h>

#include <bit>

namespace asperity::cli {

namespace {

std::uint64_t rays_of(const RayCounts& rays) {
    return rays.primary + rays.shadow + rays.bounce;
}

double rays_per_second(const Picture& p) {
    if (!(p.outcome.seconds > 0)) return 0;
    return static_cast<double>(rays_of(p.renderer.rays())) / p.outcome.seconds;
}

std::string counted(std::uint64_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

double mean_luminance(const Film& film) {
    double sum = 0;
    for (const Pixel& pixel : film.pixels()) sum += luminance(pixel.mean);
    return sum / static_cast<double>(film.pixels().size());
}

Json json_of(Vec3 v) {
    return Json::array({v.x, v.y, v.z});
}

Json json_of(const LoadedModel& loaded) {
    const ModelStatistics s = statistics(loaded.model);
    return {{"name", loaded.model.name},
            {"meshes", s.meshes},
            {"instances", s.instances},
            {"unique_triangles", s.unique_triangles},
            {"unique_vertices", s.unique_vertices},
            {"instanced_triangles", s.instanced_triangles},
            {"instanced_vertices", s.instanced_vertices},
            {"dropped_triangles", loaded.dropped_triangles},
            {"remarks", loaded.remarks}};
}

}  // namespace

std::string model_lines(const LoadedModel& loaded) {
    const ModelStatistics s = statistics(loaded.model);
    std::string text = fmt::format("model: {}, {}, {}, {} and {}", loaded.model.name,
                                   counted(s.meshes, "mesh", "meshes"),
                                   counted(s.instances, "instance", "instances"),
                                   counted(s.unique_triangles, "triangle", "triangles"),
                                   counted(s.unique_vertices, "vertex", "vertices"));
    if (s.instanced_triangles != s.unique_triangles) {
        text +=
            fmt::format("; with instances {} and {}", s.instanced_triangles, s.instanced_vertices);
    }
    text += '\n';
    if (loaded.dropped_triangles > 0) {
        text +=
            fmt::format("model: {} without area or with vertices that are not finite left out\n",
                        counted(loaded.dropped_triangles, "triangle", "triangles"));
    }
    for (const std::string& remark : loaded.remarks) text += "model: " + remark + "\n";
    return text;
}

std::string scene_lines(const ModelScene& scene) {
    std::string text;
    if (scene.split) {
        text +=
            fmt::format("left: {}\nright: {}\n", scene.material.name(), scene.split->right.name());
    } else {
        text += fmt::format("material: {}\n", scene.material.name());
    }
    for (const auto& light : scene.lights) text += fmt::format("light: {}\n", light->name());
    return text;
}

std::string outcome_line(const Picture& p) {
    const RenderSettings& s = p.renderer.settings();
    std::string text = fmt::format("{} x {} pixels, {}", s.width, s.height,
                                   counted(p.outcome.samples, "sample", "samples"));
    if (p.outcome.samples > 1) text += fmt::format(", noise {:.2g} %", 100 * p.outcome.noise);
    return text + fmt::format(", {:.1f} s, {}rays/s\n", p.outcome.seconds,
                              short_number(rays_per_second(p)));
}

std::string checksum(const Film& film) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const float value : film.image().rgb) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
        for (int shift = 0; shift < 32; shift += 8) {
            hash = (hash ^ (bits >> shift & 0xffu)) * 0x100000001b3u;
        }
    }
    return fmt::format("{:016x}", hash);
}

Json to_json(const Picture& p) {
    const RayCounts& rays = p.renderer.rays();
    const RenderSettings& s = p.renderer.settings();
    Json json = {{"version", kVersion}, {"model", json_of(p.loaded)}};
    json["materials"] = Json::array({p.scene.material.name()});
    if (p.scene.split) json["materials"].push_back(p.scene.split->right.name());
    json["lights"] = Json::array();
    for (const auto& light : p.scene.lights) json["lights"].push_back(light->name());
    json["camera"] = {{"position", json_of(p.camera.position)},
                      {"forward", json_of(p.camera.forward)},
                      {"up", json_of(p.camera.up)},
                      {"fov_deg", p.camera.fov_deg}};
    json["width"] = s.width;
    json["height"] = s.height;
    json["seed"] = s.seed;
    json["samples"] = p.outcome.samples;
    json["noise"] = nullptr;  // not known from a single sample
    if (p.outcome.samples > 1) json["noise"] = p.outcome.noise;
    json["mean_luminance"] = mean_luminance(p.renderer.film());
    json["stopped"] = p.outcome.stopped;
    json["seconds"] = p.outcome.seconds;
    json["rays"] = {{"primary", rays.primary},
                    {"shadow", rays.shadow},
                    {"bounce", rays.bounce},
                    {"invalid", rays.invalid}};
    json["rays_per_second"] = rays_per_second(p);
    json["checksum"] = checksum(p.renderer.film());
    json["files"] = p.files;
    return json;
}

io::Provenance outcome_provenance(const Picture& p) {
    io::Provenance told = {{"version", kVersion}, {"samples", std::to_string(p.outcome.samples)}};
    if (p.outcome.samples > 1) told.emplace_back("noise", shortest(p.outcome.noise));
    if (p.outcome.stopped) told.emplace_back("stopped", "before it was as asked");
    return told;
}

}  // namespace asperity::cli
