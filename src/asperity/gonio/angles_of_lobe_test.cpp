// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/gonio/measure.h>
#include <asperity/gonio/measurement_ranges.h>
#include <asperity/surface/make_surface.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

double widest_step(const std::vector<double>& angles, double from, double to) {
    double widest = 0;
    for (std::size_t k = 1; k < angles.size(); ++k)
        if (angles[k - 1] >= from && angles[k] <= to)
            widest = std::max(widest, angles[k] - angles[k - 1]);
    return widest;
}

TEST(AnglesOfLobe, AreCloserTowardsTheHorizon) {
    for (const double alpha : {0.0, 0.01, 0.1, 0.3, 0.6, 1.2, 6.0}) {
        const std::vector<double> angles = angles_of_lobe(alpha, {});
        EXPECT_EQ(angles.front(), 0);
        EXPECT_LT(angles.back(), 90);
        EXPECT_GT(angles.back(), 89.5);
        EXPECT_LE(angles.size(), 30u) << alpha;
        for (std::size_t k = 1; k < angles.size(); ++k) {
            EXPECT_GT(angles[k], angles[k - 1]);
            EXPECT_LE(angles[k] - angles[k - 1], 0.4 * (90 - angles[k - 1]) + 0.05) << alpha;
            EXPECT_LE(angles[k] - angles[k - 1], 10.01);
        }
    }
    EXPECT_EQ(angles_of_lobe(0.1, {}).size(), angles_of_lobe(0.6, {}).size());
}

TEST(AnglesOfLobe, FollowSlopesAndReflectance) {
    EXPECT_GT(widest_step(angles_of_lobe(0.3, {}), 0, 60), 9);
    EXPECT_LT(widest_step(angles_of_lobe(1.5, {}), 0, 60), 7);
    // Smooth surfaces have shadows at the horizon alone
    EXPECT_GT(angles_of_lobe(0.01, {}).back(), angles_of_lobe(0.3, {}).back());
    OpticsSettings glass;
    glass.fresnel = FresnelKind::Dielectric;
    glass.ior = {1.5};
    // 0.04 at the normal, 0.10 at 63 degrees, 0.39 at 80: a straight line would be far off
    EXPECT_LT(widest_step(angles_of_lobe(0.3, glass), 50, 80), 5.5);
    EXPECT_GT(widest_step(angles_of_lobe(0.3, glass), 0, 30), 9);
}

TEST(AnglesOfLobe, AResultTellsItsOwn) {
    SurfaceSettings flat;
    flat.kind = "gaussian";
    flat.size = 32;
    Experiment e;
    e.surface = flat;
    e.detector.resolution = 8;
    e.run.rays = 2000;
    e.illumination.layers = 0;
    EXPECT_THROW(incidences(e.illumination), Error);
    asperity::Run run(1);
    const Heightfield surface = make_surface(flat, run);
    const Measurement m = measure(surface, e, run);
    EXPECT_EQ(m.experiment.illumination.layers, 0);
    EXPECT_EQ(m.experiment.illumination.theta_deg,
              with_angles(surface, e, run).illumination.theta_deg);
    ASSERT_EQ(m.layers.size(), m.experiment.illumination.theta_deg.size());
    EXPECT_EQ(m.layers[0].theta_i, 0);
    EXPECT_NEAR(degrees(m.layers.back().theta_i), m.experiment.illumination.theta_deg.back(), 1e-9);
    EXPECT_EQ(out_of_range(m), "");
    Measurement forged = m;
    forged.experiment.illumination.theta_deg.clear();
    EXPECT_NE(out_of_range(forged), "");
    // Angles that are given are not chosen
    e.illumination.theta_deg = {10, 20};
    EXPECT_EQ(with_angles(surface, e, run).illumination.theta_deg, e.illumination.theta_deg);
}

TEST(AnglesOfLobe, StopsWithTheRun) {
    SurfaceSettings settings;
    settings.size = 64;
    asperity::Run run(1);
    const Heightfield surface = make_surface(settings, run);
    Experiment e;
    e.surface = settings;
    e.illumination.layers = 0;
    run.request_stop();
    const Measurement m = measure(surface, e, run);
    EXPECT_TRUE(m.stopped);
    EXPECT_TRUE(m.layers.empty());
}

}  // namespace
}  // namespace asperity
