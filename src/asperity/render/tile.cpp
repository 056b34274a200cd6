// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/tile.h>

#include <pmmintrin.h>

#include <algorithm>

namespace asperity {

namespace {

/// Takes numbers below 1e-38 (1e-308) as 0 while it lives, as Embree asks of its users: they slow
/// it down.
class FlushDenormals {
  public:
    FlushDenormals() : before_(_mm_getcsr()) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned before_;
};

/// A number in (-1, 1) that comes up less often towards the ends, from one in [0, 1).
double tent(double u) {
    return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

/// Where in the picture a sample of a pixel lies, as seen from its middle [pixels].
std::array<double, 2> place(PixelFilter filter, std::array<double, 2> u) {
    switch (filter) {
        case PixelFilter::Centre:
            return {0, 0};
        case PixelFilter::Box:
            return {u[0] - 0.5, u[1] - 0.5};
        case PixelFilter::Tent:
            break;
    }
    return {tent(u[0]), tent(u[1])};
}

/// Starts a path at the camera, through pixel (x, y).
Path start(const View& view, int x, int y, std::uint32_t pixel, std::uint32_t sample) {
    PixelSampler sampler(view.settings.seed, pixel, sample);
    const auto offset = place(view.settings.filter, sampler.next2());
    const WorldRay ray = view.rays.at(x + 0.5 + offset[0], y + 0.5 + offset[1]);
    const auto& split = view.scene.split;
    const bool right = split && x + 0.5 >= split->position * view.settings.width;
    return {ray, sampler, right ? &split->right : &view.scene.material, {}, {1, 1, 1}, 0};
}

}  // namespace

Tile TileGrid::tile(std::size_t k) const {
    const int x = static_cast<int>(k % static_cast<std::size_t>(columns())) * kTileSide;
    const int y = static_cast<int>(k / static_cast<std::size_t>(columns())) * kTileSide;
    return {x, y, std::min(kTileSide, width - x), std::min(kTileSide, height - y)};
}

std::uint64_t render_tile(const View& view, const Tile& tile, std::uint32_t sample,
                          std::span<const std::uint8_t> chosen, Film& film, RayCounts& counts) {
    const FlushDenormals flush;
    std::vector<Path> paths;
    std::vector<std::uint32_t> pixels;
    paths.reserve(tile.pixels());
    pixels.reserve(tile.pixels());
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const auto pixel = static_cast<std::uint32_t>(y * view.settings.width + x);
            if (film.at(x, y).samples > sample || (!chosen.empty() && chosen[pixel] == 0)) continue;
            pixels.push_back(pixel);
            paths.push_back(start(view, x, y, pixel, sample));
        }
    }

    Wave wave(view, paths, counts);
    if (view.settings.integrator == Integrator::Stratified)
        trace_strata(wave, pixels, sample);
    else
        trace_paths(wave);

    const auto width = static_cast<std::uint32_t>(view.settings.width);
    for (std::size_t k = 0; k < paths.size(); ++k) {
        const bool valid = is_finite(paths[k].radiance);
        if (!valid) ++counts.invalid;
        film.at(static_cast<int>(pixels[k] % width), static_cast<int>(pixels[k] / width))
            .add(valid ? paths[k].radiance : Rgb{});
    }
    return paths.size();
}

}  // namespace asperity
