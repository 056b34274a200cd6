// SPDX-License-Identifier: Apache-2.0
//
// Helmholtz reciprocity of the simulated BRDF, f(wi, wo) = f(wo, wi), judged by its own error bars.
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace asperity {
namespace {

/// A cell of 3 x 6 degrees of a 60-column detector, and light that fills it: a finite surface
/// glitters, so both ends of a path must be averaged alike. The light comes from 4 x 4 directions,
/// midpoints of parts of equal projected solid angle.
constexpr int kResolution = 60, kParts = 4;
constexpr std::array kRows = {3, 8, 12, 16, 20};
constexpr std::array kColumns = {0, 12, 30, 45};

Measurement measure_all_cells(const SurfaceSettings& settings, const OpticsSettings& optics) {
    asperity::Run run(0);
    const Heightfield surface = make_surface(settings, run);
    Experiment e;
    e.optics = optics;
    e.detector.resolution = kResolution;
    e.run.rays = 30000;
    e.run.bounces = 64;
    const Detector detector(e.detector);
    e.illumination.phi_deg.clear();
    for (const int row : kRows)
        for (int part = 0; part < kParts; ++part) {
            const double a = std::pow(std::sin(detector.theta_edge(row)), 2);
            const double b = std::pow(std::sin(detector.theta_edge(row + 1)), 2);
            const double share = (part + 0.5) / kParts;
            e.illumination.theta_deg.push_back(degrees(std::asin(std::sqrt(a + share * (b - a)))));
        }
    for (const int column : kColumns)
        for (int part = 0; part < kParts; ++part)
            e.illumination.phi_deg.push_back((column + (part + 0.5) / kParts) * 360 / kResolution);
    return measure(surface, e, run);
}

struct Estimate {
    double f = 0, variance = 0;
};

/// Mean of f over light from cell `from` (index into kRows x kColumns) and the outgoing cell `to`.
Estimate mean_brdf(const Measurement& m, int from, int to, int channel) {
    const auto cell_of = [](int k) {
        return kRows[static_cast<std::size_t>(k / 4)] * kResolution +
               kColumns[static_cast<std::size_t>(k % 4)];
    };
    constexpr int kPhis = static_cast<int>(kColumns.size()) * kParts;
    Estimate mean;
    for (int p = 0; p < kParts; ++p)
        for (int q = 0; q < kParts; ++q) {
            const int layer = (from / 4 * kParts + p) * kPhis + from % 4 * kParts + q;
            const Layer& l = m.layers[static_cast<std::size_t>(layer)];
            mean.f += m.brdf(l, channel, cell_of(to)) / (kParts * kParts);
            mean.variance +=
                std::pow(m.brdf_stderr(l, channel, cell_of(to)) / (kParts * kParts), 2);
        }
    return mean;
}

struct Scores {
    int pairs = 0;
    double sum = 0, sum_of_squares = 0, largest = 0;
};

Scores z_scores(const SurfaceSettings& settings, const OpticsSettings& optics) {
    const Measurement m = measure_all_cells(settings, optics);
    Scores scores;
    for (int a = 0; a < 20; ++a)
        for (int b = a + 1; b < 20; ++b) {
            const Estimate there = mean_brdf(m, a, b, 0), back = mean_brdf(m, b, a, 0);
            // Error bars of a handful of hits are skewed
            if (!(std::sqrt(there.variance) < 0.15 * there.f)) continue;
            if (!(std::sqrt(back.variance) < 0.15 * back.f)) continue;
            const double z = (there.f - back.f) / std::sqrt(there.variance + back.variance);
            ++scores.pairs;
            scores.sum += z;
            scores.sum_of_squares += z * z;
            scores.largest = std::max(scores.largest, std::abs(z));
        }
    return scores;
}

void expect_reciprocal(const Scores& s) {
    ASSERT_GE(s.pairs, 100);
    // Sums of 32 estimates: z is normal. Sidak over 190 pairs at 0.1 %: 4.57.
    EXPECT_LT(s.largest, 4.57);
    EXPECT_NEAR(s.sum_of_squares / s.pairs, 1, 4 * std::sqrt(2.0 / s.pairs));
    EXPECT_NEAR(s.sum / s.pairs, 0, 4 / std::sqrt(s.pairs));
}

TEST(Reciprocity, GaussianSurfaceOfPerfectMirrors) {
    SurfaceSettings s;
    s.kind = "gaussian";
    s.size = 256;
    s.alpha_x = s.alpha_y = 0.6;
    expect_reciprocal(z_scores(s, {}));
}

TEST(Reciprocity, ThesisSurfaceWithMultipleBounces) {
    SurfaceSettings s;
    s.size = 256;
    s.roughness = 0.2;
    expect_reciprocal(z_scores(s, {}));
}

TEST(Reciprocity, AnisotropicSurfaceOfCopper) {
    SurfaceSettings s;
    s.kind = "gaussian";
    s.size = 256;
    s.alpha_x = 0.9;
    s.alpha_y = 0.45;
    OpticsSettings copper;
    copper.fresnel = FresnelKind::Conductor;
    copper.ior = {1.0};
    copper.k = {2.6};
    expect_reciprocal(z_scores(s, copper));
}

}  // namespace
}  // namespace asperity
