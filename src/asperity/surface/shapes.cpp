// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/shapes.h>

#include <asperity/core/directions.h>
#include <asperity/surface/blocks.h>

namespace asperity {

namespace {

constexpr int kRowsPerBlock = 16;

/// Height of the shape along its own axis at sample i; `step` is the distance between samples.
double profile(const SurfaceSettings& s, int i, double step) {
    const double slope = std::tan(radians(s.tilt_deg));
    const int phase = i % s.period;
    const int to_valley = std::min(phase, s.period - phase);
    const double wave = s.amplitude * std::sin(2 * kPi * phase / s.period);
    switch (s.kind) {
        case SurfaceKind::Tilted:
            return slope * step * i;
        case SurfaceKind::Sawtooth:
            return slope * step * phase;
        case SurfaceKind::VGroove:
            return slope * step * to_valley;
        case SurfaceKind::Pyramids:
            return slope * step * to_valley / std::sqrt(2.0);
        case SurfaceKind::Sinusoid:
            return wave;
        case SurfaceKind::Eggcrate:
            return wave / 2;
        default:
            return 0;
    }
}

bool varies_along_both(SurfaceKind kind) {
    return kind == SurfaceKind::Pyramids || kind == SurfaceKind::Eggcrate;
}

}  // namespace

void fill_shape(Heightfield& surface, const SurfaceSettings& settings, Run& run) {
    const bool both = varies_along_both(settings.kind);
    std::vector<double> along_x(static_cast<std::size_t>(surface.nx), 0.0);
    std::vector<double> along_y(static_cast<std::size_t>(surface.ny), 0.0);
    for (int i = 0; i < surface.nx && (both || !settings.along_y); ++i)
        along_x[static_cast<std::size_t>(i)] = profile(settings, i, surface.dx);
    for (int j = 0; j < surface.ny && (both || settings.along_y); ++j)
        along_y[static_cast<std::size_t>(j)] = profile(settings, j, surface.dy);

    for_blocks(surface.ny, kRowsPerBlock, run, [&](int first, int last) {
        for (auto j = static_cast<std::size_t>(first); j < static_cast<std::size_t>(last); ++j)
            for (std::size_t i = 0; i < along_x.size(); ++i)
                surface.heights[j * along_x.size() + i] =
                    static_cast<float>(along_x[i] + along_y[j]);
        run.advance(static_cast<std::uint64_t>(last - first));
    });
}

}  // namespace asperity
