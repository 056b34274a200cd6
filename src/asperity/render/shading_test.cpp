// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/random.h>
#include <asperity/render/shading.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

Vec3 random_direction(const CounterRandom& random, std::uint64_t index, std::uint32_t dimension) {
    const auto u = random.uniform2(index, dimension);
    const double z = 1 - 2 * u[0], r = std::sqrt(1 - z * z);
    return {r * std::cos(2 * kPi * u[1]), r * std::sin(2 * kPi * u[1]), z};
}

SurfacePoint point_with(Vec3 geometric, Vec3 shading) {
    SurfacePoint point;
    point.geometric_normal = geometric;
    point.shading_normal = shading;
    return point;
}

TEST(ShadingFrame, IsOrthonormalLevelAndTurnedNoFartherThanNeeded) {
    const CounterRandom random(7, 0);
    int turned = 0;
    for (std::uint64_t k = 0; k < 10000; ++k) {
        const Vec3 view = random_direction(random, k, 0), normal = random_direction(random, k, 1);
        const ShadingFrame f = shading_frame(point_with(normal, normal), view);
        EXPECT_NEAR(dot(f.x, f.x), 1, 1e-12);
        EXPECT_NEAR(dot(f.y, f.y), 1, 1e-12);
        EXPECT_NEAR(dot(f.x, f.y), 0, 1e-12);
        EXPECT_NEAR(length(cross(f.x, f.y) - f.z), 0, 1e-12);
        EXPECT_NEAR(f.x.y, 0, 1e-12) << "x is level";
        EXPECT_NEAR(length(f.to_world(f.to_local(view)) - view), 0, 1e-12);
        if (dot(normal, view) >= 0.01) {
            EXPECT_EQ(f.z, normal);
        } else {
            ++turned;
            EXPECT_NEAR(dot(f.z, view), 0.01, 1e-12);
            EXPECT_NEAR(dot(f.z, cross(normal, view)), 0, 1e-12) << "in the plane of both";
            EXPECT_GT(dot(f.z, normal - dot(normal, view) * view), 0) << "by the shorter way";
        }
    }
    EXPECT_GT(turned, 1000);
}

TEST(ShadingFrame, HasAnXWhereTheNormalIsVertical) {
    for (const double y : {1.0, -1.0}) {
        const Vec3 up{0, y, 0};
        const ShadingFrame f = shading_frame(point_with(up, up), up);
        EXPECT_EQ(f.x, (Vec3{1, 0, 0}));
        EXPECT_EQ(f.y, cross(up, f.x));
    }
    // Looked at from behind: nothing left to turn by
    const ShadingFrame f = shading_frame(point_with({0, 0, 1}, {0, 0, 1}), {0, 0, -1});
    EXPECT_GE(f.z.z * -1, 0.01);
}

TEST(Terminator, IsOneForFlatFacetsAndZeroBehindThem) {
    const CounterRandom random(8, 0);
    for (std::uint64_t k = 0; k < 1000; ++k) {
        const Vec3 normal = random_direction(random, k, 0), light = random_direction(random, k, 1);
        const SurfacePoint point = point_with(normal, normal);
        EXPECT_DOUBLE_EQ(terminator_softness(point, light), lit_from(point, light) ? 1.0 : 0.0);
    }
}

TEST(Terminator, FollowsChiangsCurve) {
    // G = min(1, 2 (ng . l) / ((ns . l) (ng . ns))), let through: G + G^2 - G^3. In the plane of
    // all three, ng at 0, ns at 30 degrees to one side, the light at 60 to the other: ng . l = 1 /
    // 2, ns . l = cos 90 = 0; at 50 degrees: cos 50 / (cos 80 cos 30) > 1.
    const Vec3 ng{0, 0, 1};
    const auto tilted = [](double deg) { return from_spherical(radians(deg), 0); };
    EXPECT_DOUBLE_EQ(terminator_softness(point_with(ng, tilted(-30)), tilted(50)), 1);
    // The other way round: 2 cos 80 / (cos 50 cos 30) = 0.623882
    const double g = 2 * std::cos(radians(80)) / (std::cos(radians(50)) * std::cos(radians(30)));
    EXPECT_NEAR(g, 0.623882, 1e-6);
    EXPECT_NEAR(terminator_softness(point_with(ng, tilted(30)), tilted(80)),
                0.623882 + 0.623882 * 0.623882 - std::pow(0.623882, 3), 1e-5);
    // A fine mesh: tilted by half a degree, whole to the last degree but one
    EXPECT_EQ(terminator_softness(point_with(ng, tilted(0.5)), tilted(88.5)), 1);
    EXPECT_LT(terminator_softness(point_with(ng, tilted(0.5)), tilted(89.8)), 1);
    // No jump where the triangle's own shadow begins
    EXPECT_LT(terminator_softness(point_with(ng, tilted(30)), tilted(89.999)), 1e-4);
    // The surface looks away: black by itself, whatever is let through
    EXPECT_EQ(terminator_softness(point_with(ng, tilted(-60)), tilted(60)), 1);
}

}  // namespace
}  // namespace asperity
