// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(Directions, SphericalAnglesComeBack) {
    for (const double theta : {0.0, 1e-9, 0.3, 1.5, kPi / 2, 3.0}) {
        for (const double phi : {0.0, 0.1, 2.0, kPi, 6.28}) {
            const Vec3 w = from_spherical(theta, phi);
            EXPECT_NEAR(length(w), 1, 1e-15);
            EXPECT_NEAR(polar_angle(w), theta, 1e-15);
            if (theta > 0) {
                EXPECT_NEAR(azimuth(w), phi, 1e-9);
            }
        }
    }
}

TEST(Directions, AzimuthStaysBelowAFullTurn) {
    EXPECT_EQ(azimuth({1, 0, 0}), 0);
    EXPECT_LT(azimuth({1, -1e-300, 0}), 2 * kPi);
    EXPECT_NEAR(azimuth({0, -1, 0}), 1.5 * kPi, 1e-15);
}

TEST(Directions, MirrorAboutTheMeanNormalTurnsTheAzimuthByHalfATurn) {
    const Vec3 wi = from_spherical(0.7, 0.4);
    const Vec3 wo = reflect(wi, {0, 0, 1});
    EXPECT_NEAR(polar_angle(wo), 0.7, 1e-15);
    EXPECT_NEAR(azimuth(wo), 0.4 + kPi, 1e-15);
}

TEST(Directions, MirrorAboutATiltedNormalDoublesTheTilt) {
    // A facet tilted by 20 degrees sends light from above 40 degrees to the side.
    const Vec3 wm = from_spherical(radians(20), 0);
    EXPECT_NEAR(degrees(polar_angle(reflect({0, 0, 1}, wm))), 40, 1e-12);
}

TEST(Directions, TurnAboutTheNormal) {
    const Vec3 w = rotate_z(from_spherical(0.5, 1.0), 0.25);
    EXPECT_NEAR(azimuth(w), 1.25, 1e-15);
    EXPECT_NEAR(polar_angle(w), 0.5, 1e-15);
}

}  // namespace
}  // namespace asperity
