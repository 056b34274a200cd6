// SPDX-License-Identifier: Apache-2.0
//
// Gaussian surfaces against Smith's theory with the Beckmann distribution. The ray figures are
// those of an independent plain tracer on 2048^2 tiles, correlation length 16 (table "Gaussian
// surfaces against Smith" of docs/validation.md); the theory is our analytic model, averaged over
// the cells.
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/compare.h>
#include <asperity/surface/make_surface.h>
#include <fmt/format.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

struct Anchor {
    double theta_deg, e1, e2, e3;
};
struct Case {
    double alpha;
    std::vector<Anchor> anchors;
    double smith_excess;  // single scattering of rays over Smith, at most
    double lobe_l1;       // at most: table value, ray noise and the smaller tile's own lobe
};

class GaussianAgainstSmith : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Alphas, GaussianAgainstSmith,
                         testing::Values(Case{0.2,
                                              {{0, 1.0000, 0.0000, 0.0000},
                                               {30, 0.9999, 0.0001, 0.0000},
                                               {60, 0.9750, 0.0241, 0.0009},
                                               {75, 0.9179, 0.0711, 0.0110}},
                                              0.006,
                                              0.035},
                                         Case{0.5,
                                              {{0, 0.9516, 0.0478, 0.0007},
                                               {30, 0.9087, 0.0885, 0.0028},
                                               {60, 0.8752, 0.1068, 0.0180},
                                               {75, 0.9190, 0.0704, 0.0106}},
                                              0.022,
                                              0.055},
                                         Case{0.8,
                                              {{0, 0.6541, 0.3308, 0.0152},
                                               {30, 0.7028, 0.2674, 0.0298},
                                               {60, 0.8353, 0.1421, 0.0226},
                                               {75, 0.9169, 0.0740, 0.0092}},
                                              0.030,
                                              0.065}));

TEST_P(GaussianAgainstSmith, EnergiesByBounceAndSingleScatteringLobe) {
    const Case& expected = GetParam();
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.size = 1024;
    settings.correlation_x = settings.correlation_y = 6;
    settings.alpha_x = settings.alpha_y = expected.alpha;
    asperity::Run run(0);
    const Heightfield surface = make_surface(settings, run);
    Experiment e;
    e.illumination.isotropic = true;
    for (const Anchor& a : expected.anchors) e.illumination.theta_deg.push_back(a.theta_deg);
    e.detector.resolution = 36;  // cells of 5 x 10 degrees
    e.run.rays = 1000000;
    e.run.bounces = 32;
    const Measurement m = measure(surface, e, run);
    const auto smith = parse_brdf_spec(fmt::format("beckmann:alpha={}", expected.alpha));

    for (std::size_t k = 0; k < m.layers.size(); ++k) {
        const Layer& layer = m.layers[k];
        const Anchor& a = expected.anchors[k];
        SCOPED_TRACE(fmt::format("alpha {} theta {}", expected.alpha, a.theta_deg));
        const double e1 = m.albedo(layer, 0, 0), e2 = m.albedo(layer, 1, 0);
        // Tile-to-tile spread at 170 correlation lengths: about 0.3 %
        EXPECT_NEAR(e1, a.e1, 0.006);
        EXPECT_NEAR(e2, a.e2, 0.006);
        EXPECT_NEAR(1 - e1 - e2, a.e3, 0.004);

        const CellAverages model =
            average_over_cells(*smith, m.detector, layer.theta_i, 0, true, run.threads());
        EXPECT_GT(e1 / model.albedo[0], 1 - 0.004);
        EXPECT_LT(e1 / model.albedo[0], 1 + expected.smith_excess);
        double l1 = 0;
        for (int cell = 0; cell < m.detector.cells(); ++cell)
            l1 += std::abs(m.energy(layer, 0, 0, cell) -
                           model.energy[static_cast<std::size_t>(cell)]);
        EXPECT_LT(l1, expected.lobe_l1);
    }
}

}  // namespace
}  // namespace asperity
