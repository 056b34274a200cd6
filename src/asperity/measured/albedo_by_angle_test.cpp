// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/albedo_by_angle.h>

#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

/// One layer, two channels, five bounces; shares of channel 0: .5 .2 .1 .06 .04, channel 1 half.
Measurement two_channels() {
    Measurement m;
    m.channel_names = {"a", "b"};
    m.experiment.run.bounces = 5;
    Layer layer;
    layer.theta_i = 0.7;
    layer.phi_i = 0.2;
    layer.rays = 1000;
    const double unit = static_cast<double>(kRayEnergy) * 1000;
    for (const double scale : {1.0, 0.5}) {
        double sum = 0;
        for (const double share : {.5, .2, .1, .06, .04}) {
            layer.escaped_by_bounce.push_back(static_cast<std::uint64_t>(share * scale * unit));
            layer.stderr_albedo_by_bounce.push_back(0.01 * share * scale);
            sum += share * scale;
        }
        layer.escaped.push_back(static_cast<std::uint64_t>(sum * unit));
        layer.stderr_albedo.push_back(0.004 * scale);
    }
    m.layers.push_back(layer);
    return m;
}

TEST(AlbedoByAngleTest, TheLastGroupHoldsAllHigherOrders) {
    const Measurement m = two_channels();
    const AlbedoByBounce albedo = albedo_by_bounce(m, m.layers[0], 4, 0);
    EXPECT_EQ(albedo.theta_i, 0.7);
    EXPECT_EQ(albedo.phi_i, 0.2);
    EXPECT_NEAR(albedo.total.value, 0.9, 1e-9);
    EXPECT_NEAR(albedo.total.error, 0.004, 1e-12);
    ASSERT_EQ(albedo.order.size(), 4u);
    EXPECT_NEAR(albedo.order[0].value, 0.5, 1e-9);
    EXPECT_NEAR(albedo.order[2].value, 0.1, 1e-9);
    EXPECT_NEAR(albedo.order[3].value, 0.1, 1e-9);
    EXPECT_NEAR(albedo.order[3].error, 0.001, 1e-12);
}

TEST(AlbedoByAngleTest, MeanOfTheChannels) {
    const Measurement m = two_channels();
    const AlbedoByBounce albedo = albedo_by_bounce(m, m.layers[0], 2, -1);
    EXPECT_NEAR(albedo.total.value, 0.675, 1e-9);
    EXPECT_NEAR(albedo.total.error, 0.003, 1e-12);
    EXPECT_NEAR(albedo.order[1].value, 0.3, 1e-9);
    EXPECT_THROW(albedo_by_bounce(m, m.layers[0], 4, 2), Error);
}

TEST(AlbedoByAngleTest, FewerBouncesThanGroups) {
    const Measurement m = two_channels();
    EXPECT_EQ(albedo_by_bounce(m, m.layers[0], 9, 0).order.size(), 5u);
}

TEST(AlbedoByAngleTest, OfAModel) {
    const LambertBrdf colour({0.2, 0.8});
    EXPECT_NEAR(albedo_at(colour, radians(60), 1), 0.8, 1e-12);
    EXPECT_NEAR(albedo_at(colour, radians(60), -1), 0.5, 1e-12);
    EXPECT_THROW(albedo_at(colour, 0, 2), Error);
}

}  // namespace
}  // namespace asperity
