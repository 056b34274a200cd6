// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/geometric_optics.h>

#include <asperity/core/length.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/statistics.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

constexpr double kWavelengthsOfRadius = 5;

/// Heights around a sample, which must not lie on the edge of a patch.
class Neighbourhood {
  public:
    Neighbourhood(const Heightfield& surface, int i, int j) : s_(surface), i_(i), j_(j) {}

    double at(int a, int b) const {
        const int i = wrapped(i_ + a, s_.nx), j = wrapped(j_ + b, s_.ny);
        return static_cast<double>(
            s_.heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(s_.nx) +
                       static_cast<std::size_t>(i)]);
    }
    double slope_x(int step) const { return (at(step, 0) - at(0, 0)) / (step * s_.dx); }
    double slope_y(int step) const { return (at(0, step) - at(0, 0)) / (step * s_.dy); }

    /// The larger principal curvature, by size: of the Weingarten map of the graph.
    double curvature() const {
        const double p = (at(1, 0) - at(-1, 0)) / (2 * s_.dx),
                     q = (at(0, 1) - at(0, -1)) / (2 * s_.dy);
        const double r = (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / (s_.dx * s_.dx),
                     t = (at(0, 1) - 2 * at(0, 0) + at(0, -1)) / (s_.dy * s_.dy),
                     m = (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1)) / (4 * s_.dx * s_.dy);
        const double w = 1 + p * p + q * q;
        const double mean =
            ((1 + q * q) * r - 2 * p * q * m + (1 + p * p) * t) / (2 * w * std::sqrt(w));
        const double gauss = (r * t - m * m) / (w * w);
        return std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
    }

  private:
    static int wrapped(int k, int n) { return k < 0 ? k + n : k >= n ? k - n : k; }

    const Heightfield& s_;
    int i_, j_;
};

struct Sums {
    double count = 0, sharp = 0, slopes = 0, wide_slopes = 0;

    Sums& operator+=(const Sums& o) {
        count += o.count;
        sharp += o.sharp;
        slopes += o.slopes;
        wide_slopes += o.wide_slopes;
        return *this;
    }
};

Sums sums_of(const Heightfield& surface, double wavelength, const Run& run) {
    const bool periodic = surface.boundary == Boundary::Periodic;
    const int first = periodic ? 0 : 1, spare = periodic ? 0 : 2;
    const double sharpest = 1 / (kWavelengthsOfRadius * wavelength);
    return sum_rows<Sums>(
        std::max(0, surface.ny - first - spare), run.threads(), [&](Sums& part, int row) {
            throw_if_stopped(run);
            for (int i = first; i < surface.nx - spare; ++i) {
                const Neighbourhood near(surface, i, row + first);
                part.count += 1;
                if (near.curvature() > sharpest) part.sharp += 1;
                const auto square = [](double x, double y) { return x * x + y * y; };
                part.slopes += square(near.slope_x(1), near.slope_y(1));
                part.wide_slopes += square(near.slope_x(2), near.slope_y(2));
            }
        });
}

std::string verdict_of(const GeometricOptics& g) {
    const std::string light = length_text(g.wavelength);
    std::string why;
    const auto add = [&](const std::string& reason) {
        why += (why.empty() ? "" : ", and ") + reason;
    };
    if (g.coherent_share > kCoherentShare)
        add(
            fmt::format("the heights are small against the wavelength: about {:.3g} % of the "
                        "reflected light stays in the mirror direction by interference",
                        100 * g.coherent_share));
    if (g.sharp_share > kSharpShare)
        add(fmt::format("{:.3g} % of the area is curved more sharply than 5 wavelengths",
                        100 * g.sharp_share));
    if (!why.empty()) return fmt::format("geometric optics does not hold at {}: {}", light, why);
    if (g.slope_ratio < kSlopeRatio)
        return fmt::format(
            "geometric optics may hold at {}, but the slopes are not resolved: "
            "finer samples would find steeper ones",
            light);
    return "geometric optics holds at " + light;
}

}  // namespace

GeometricOptics geometric_optics(const Heightfield& surface, double wavelength, const Run& run) {
    GeometricOptics g;
    g.wavelength = wavelength;
    const Sums sums = sums_of(surface, wavelength, run);
    if (sums.count > 0) g.sharp_share = sums.sharp / sums.count;
    if (sums.slopes > 0) g.slope_ratio = std::sqrt(sums.wide_slopes / sums.slopes);
    g.rms_height = statistics(surface, run).rms_height / wavelength;
    g.coherent_share = std::exp(-std::pow(4 * std::numbers::pi * g.rms_height, 2));
    g.spacing = std::max(surface.dx, surface.dy) / wavelength;
    g.holds = g.sharp_share <= kSharpShare && g.coherent_share <= kCoherentShare &&
              g.slope_ratio >= kSlopeRatio;
    g.verdict = verdict_of(g);
    return g;
}

}  // namespace asperity
