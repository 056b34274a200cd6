// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/detector/illumination.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(Illumination, ThesisLayersGoFromNormalIncidenceDown) {
    const auto list = incidences(IlluminationSettings{});
    ASSERT_EQ(list.size(), 15u);
    EXPECT_EQ(list.front().number, 15);
    EXPECT_EQ(list.front().theta, 0);
    EXPECT_EQ(list.back().number, 1);
    EXPECT_NEAR(degrees(list.back().theta), 84, 1e-12);  // elevation 6 degrees
    EXPECT_NEAR(degrees(list[5].theta), 30, 1e-12);
}

TEST(Illumination, ListsOfAnglesMakeEveryPair) {
    IlluminationSettings light;
    light.theta_deg = {10, 20};
    light.phi_deg = {0, 45, 90};
    const auto list = incidences(light);
    ASSERT_EQ(list.size(), 6u);
    EXPECT_EQ(list[4].number, 5);
    EXPECT_NEAR(degrees(list[4].theta), 20, 1e-12);
    EXPECT_NEAR(degrees(list[4].phi), 45, 1e-12);
}

}  // namespace
}  // namespace asperity
