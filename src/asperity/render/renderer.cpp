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

bool Renderer::render_pass(Run& run) {
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
        const Tile tile = grid.tile(behind[k]);
        RayCounts counts;
        render_tile(view, tile, sample, film_, counts);
        ++tile_samples_[behind[k]];
        run.advance(tile.pixels());
        const std::lock_guard lock(counts_mutex);
        rays_ = sum(rays_, counts);
    });
    return samples() > sample;
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
