// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/render/renderer.h>
#include <asperity/render/tile.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace asperity {

namespace {

/// The noise is looked at from so many samples on.
constexpr std::uint32_t kFirstLook = 16;

RenderSettings checked(const RenderSettings& settings) {
    check(settings);
    return settings;
}

ModelScene checked(ModelScene scene) {
    if (scene.model == nullptr) throw Error(ErrorCode::Usage, "there is no model", "model");
    for (const auto& light : scene.lights)
        if (light == nullptr) throw Error(ErrorCode::Usage, "there is no such light", "light");
    return scene;
}

RayCounts sum(const RayCounts& a, const RayCounts& b) {
    return {a.primary + b.primary, a.shadow + b.shadow, a.bounce + b.bounce, a.invalid + b.invalid};
}

/// Samples that the pixels of a film are short of.
std::uint64_t missing(const Film& film, std::uint32_t samples) {
    std::uint64_t n = 0;
    for (const Pixel& pixel : film.pixels()) n += samples - std::min(pixel.samples, samples);
    return n;
}

}  // namespace

Renderer::Renderer(ModelScene scene, const Camera& camera, const RenderSettings& settings)
    : scene_(checked(std::move(scene))),
      camera_(camera),
      settings_(checked(settings)),
      film_(settings_.width, settings_.height),
      tile_samples_(TileGrid{settings_.width, settings_.height}.count(), 0),
      lights_(scene_.lights, settings_) {}

void Renderer::sample_tiles(Run& run, std::span<const std::uint8_t> chosen) {
    const TileGrid grid{settings_.width, settings_.height};
    const View view{scene_, settings_, lights_,
                    PixelRays(camera_, settings_.width, settings_.height)};
    std::vector<std::size_t> behind;
    const std::uint32_t sample = samples();
    for (std::size_t k = 0; k < tile_samples_.size(); ++k)
        if (tile_samples_[k] == sample) behind.push_back(k);

    std::mutex counts_mutex;
    parallel_for(behind.size(), run.threads(), [&](std::size_t k) {
        if (!run.keep_going()) return;
        RayCounts counts;
        run.advance(render_tile(view, grid.tile(behind[k]), sample, chosen, film_, counts));
        if (chosen.empty()) ++tile_samples_[behind[k]];
        const std::lock_guard lock(counts_mutex);
        rays_ = sum(rays_, counts);
    });
}

bool Renderer::render_pass(Run& run) {
    const std::uint32_t before = samples();
    sample_tiles(run, {});
    return samples() > before;
}

bool Renderer::begin_pass(Run& run, std::span<const std::uint8_t> chosen) {
    if (chosen.size() != film_.pixels().size())
        throw Error(ErrorCode::Usage, "a pass is begun with one entry for each pixel", "chosen");
    sample_tiles(run, chosen);
    return !run.stop_requested();
}

std::uint32_t Renderer::samples() const {
    return *std::min_element(tile_samples_.begin(), tile_samples_.end());
}

RenderOutcome render(Renderer& renderer, Run& run) {
    const RenderSettings& settings = renderer.settings();
    RenderOutcome outcome;
    run.begin("rendering", missing(renderer.film(), settings.spp));
    std::uint32_t next_look = kFirstLook;
    while (renderer.samples() < settings.spp) {
        if (!renderer.render_pass(run)) {
            outcome.stopped = true;
            break;
        }
        const std::uint32_t samples = renderer.samples();
        if (settings.until <= 0 || samples < next_look) continue;
        if (noise(renderer.film()) <= settings.until) break;
        next_look = samples + (samples + 7) / 8;
    }
    run.end();
    outcome.seconds = run.progress().seconds;
    outcome.samples = renderer.samples();
    outcome.noise = noise(renderer.film());
    return outcome;
}

}  // namespace asperity
