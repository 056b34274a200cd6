// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/areal_parameters.h>

#include <asperity/surface/autocorrelation.h>
#include <asperity/surface/spectral_density.h>
#include <asperity/surface/statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace asperity {

namespace {

constexpr double kContour = 0.2;  // of the autocorrelation, ISO 25178-2's default for Sal and Str

/// A straight line over material ratios 0 .. 1.
struct Line {
    double at_0 = 0, at_1 = 0;
};

/// The core line of the material ratio curve: through the 40 % of the points over which it falls
/// least, by least squares.
Line core_line(const std::vector<float>& falling) {
    const std::size_t n = falling.size();
    const std::size_t span =
        std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(0.4 * static_cast<double>(n))));
    std::size_t best = 0;
    for (std::size_t k = 0; k + span <= n; ++k)
        if (falling[k] - falling[k + span - 1] < falling[best] - falling[best + span - 1]) best = k;
    double x_mean = 0, h_mean = 0;
    const auto ratio = [&](std::size_t k) {
        return (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    };
    for (std::size_t k = best; k < best + span; ++k) {
        x_mean += ratio(k);
        h_mean += static_cast<double>(falling[k]);
    }
    x_mean /= static_cast<double>(span);
    h_mean /= static_cast<double>(span);
    double xx = 0, xh = 0;
    for (std::size_t k = best; k < best + span; ++k) {
        xx += (ratio(k) - x_mean) * (ratio(k) - x_mean);
        xh += (ratio(k) - x_mean) * (static_cast<double>(falling[k]) - h_mean);
    }
    const double slope = xx > 0 ? xh / xx : 0;
    return {h_mean - slope * x_mean, h_mean + slope * (1 - x_mean)};
}

void set_core(ArealParameters& p, std::vector<float> heights) {
    std::sort(heights.begin(), heights.end(), std::greater<>());
    const Line line = core_line(heights);
    const auto n = static_cast<double>(heights.size());
    double peaks = 0, pits = 0, above = 0, below = 0;
    for (const float height : heights) {
        const double h = static_cast<double>(height);
        if (h > line.at_0) peaks += h - line.at_0, above += 1;
        if (h < line.at_1) pits += line.at_1 - h, below += 1;
    }
    p.sk = line.at_0 - line.at_1;
    p.smr1 = 100 * above / n;
    p.smr2 = 100 * (1 - below / n);
    // Triangles of the same area on the same base
    p.spk = above > 0 ? 2 * peaks / above : 0;
    p.svk = below > 0 ? 2 * pits / below : 0;
}

}  // namespace

ArealParameters areal_parameters(const Heightfield& surface, Run& run) {
    const SurfaceStatistics s = statistics(surface, run);
    ArealParameters p;
    for (const float h : surface.heights) p.sa += std::abs(static_cast<double>(h) - s.mean_height);
    p.sa /= static_cast<double>(surface.heights.size());
    p.sq = s.rms_height;
    p.sp = s.max_height - s.mean_height;
    p.sv = s.mean_height - s.min_height;
    p.sz = p.sp + p.sv;
    p.ssk = s.skewness;
    p.sku = s.kurtosis;
    p.sdq = s.rms_gradient;
    p.sdr = s.area_ratio - 1;
    set_core(p, surface.heights);
    if (s.rms_height == 0 || surface.heights.size() > kMostTransformed) return p;

    const AutocorrelationContour contour =
        contour_of(HeightAutocorrelation(surface, run), surface.dx, surface.dy, kContour);
    if (std::isfinite(contour.nearest)) p.sal = contour.nearest;
    if (contour.closed) p.str = contour.nearest / contour.farthest;
    p.std_deg = spectral_density(surface, run).direction_deg;
    return p;
}

}  // namespace asperity
