// SPDX-License-Identifier: Apache-2.0
//
// Helmholtz reciprocity of the simulated BRDF, f(wi, wo) = f(wo, wi), judged by its own error bars.
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

/// Pairs of 20 directions that are centres of detector cells: light from one, measured in the cell
/// of the other, and back. The cells are small (3 x 6 degrees), so that the mean over a cell is the
/// value at its centre within a fraction of the error bar.
struct Scores {
    int pairs = 0;
    double sum = 0, sum_of_squares = 0, largest = 0;
};

Scores z_scores(const SurfaceSettings& settings, const OpticsSettings& optics) {
    asperity::Run run(0);
    const Heightfield surface = make_surface(settings, run);
    Experiment e;
    e.optics = optics;
    e.detector.resolution = 60;
    e.run.rays = 400000;
    e.run.bounces = 64;
    e.illumination.theta_deg = {10.5, 25.5, 37.5, 49.5, 61.5};
    e.illumination.phi_deg = {3, 75, 183, 273};
    const Measurement m = measure(surface, e, run);

    Scores scores;
    for (std::size_t a = 0; a < m.layers.size(); ++a)
        for (std::size_t b = a + 1; b < m.layers.size(); ++b) {
            const Layer &la = m.layers[a], &lb = m.layers[b];
            const int cell_a = m.detector.cell_of(from_spherical(la.theta_i, la.phi_i));
            const int cell_b = m.detector.cell_of(from_spherical(lb.theta_i, lb.phi_i));
            for (int c = 0; c < m.channels(); ++c) {
                // Error bars of a handful of hits are skewed
                if (m.energy(la, c, cell_b) * 400000 < 40) continue;
                if (m.energy(lb, c, cell_a) * 400000 < 40) continue;
                const double difference = m.brdf(la, c, cell_b) - m.brdf(lb, c, cell_a);
                const double z = difference / std::hypot(m.brdf_stderr(la, c, cell_b),
                                                         m.brdf_stderr(lb, c, cell_a));
                ++scores.pairs;
                scores.sum += z;
                scores.sum_of_squares += z * z;
                scores.largest = std::max(scores.largest, std::abs(z));
            }
        }
    return scores;
}

void expect_reciprocal(const Scores& s) {
    ASSERT_GE(s.pairs, 100);
    // Difference of two means with 31 degrees of freedom each: variance about 1.035, tails near
    // normal. Sidak over the pairs at 1 %, normal tail widened for the degrees of freedom.
    EXPECT_LT(s.largest, 4.6);
    EXPECT_NEAR(s.sum_of_squares / s.pairs, 1.035, 5 * std::sqrt(2.2 / s.pairs));
    EXPECT_NEAR(s.sum / s.pairs, 0, 5 / std::sqrt(s.pairs));
}

TEST(Reciprocity, GaussianSurfaceOfPerfectMirrors) {
    SurfaceSettings s;
    s.kind = SurfaceKind::Gaussian;
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

TEST(Reciprocity, AnisotropicSurfaceOfGlass) {
    SurfaceSettings s;
    s.kind = SurfaceKind::Gaussian;
    s.size = 256;
    s.alpha_x = 0.9;
    s.alpha_y = 0.45;
    OpticsSettings glass;
    glass.fresnel = FresnelKind::Dielectric;
    glass.ior = {1.5};
    expect_reciprocal(z_scores(s, glass));
}

}  // namespace
}  // namespace asperity
