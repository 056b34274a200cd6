// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_solid.h>

#include <asperity/core/directions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity::plots {
namespace {

const Box kBox{0, 0, 100, 100};

/// A square across the view, `x` towards a camera that looks along -x from azimuth 0.
SolidMesh square(double x, double half, Colour colour) {
    SolidMesh mesh;
    for (const auto& [y, z] :
         {std::pair{-half, 0.1}, {half, 0.1}, {half, 0.1 + 2 * half}, {-half, 0.1 + 2 * half}})
        mesh.vertices.push_back({{x, y, z}, {1, 0, 0}, colour});
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(SolidCamera, SeenFromTheSideHeightsStandUpright) {
    const SolidCamera camera(0, 0, kBox);
    const Place foot = camera.place({0, 0, 0}), top = camera.place({0, 0, 1});
    EXPECT_NEAR(top.x, foot.x, 1e-9);
    // Two wide and one high into a square of 100: 50 units to one
    EXPECT_NEAR(foot.y - top.y, 50, 1e-9);
    EXPECT_NEAR(camera.place({0, 1, 0}).x - foot.x, 50, 1e-9);
    EXPECT_GT(camera.nearness({1, 0, 0}), camera.nearness({-1, 0, 0}));
}

TEST(SolidCamera, SeenFromAboveTheGroundIsACircle) {
    const SolidCamera camera(0, kPi / 2, kBox);
    const Place middle = camera.place({0, 0, 0});
    for (int k = 0; k < 8; ++k) {
        const Place rim = camera.place(from_spherical(kPi / 2, k * kPi / 4));
        EXPECT_NEAR(std::hypot(rim.x - middle.x, rim.y - middle.y), 50, 1e-9);
    }
}

TEST(SolidRaster, NearerSurfacesHideOthersInAnyOrder) {
    const SolidCamera camera(0, 0, kBox);
    const Colour red{1, 0, 0}, blue{0, 0, 1};
    for (const bool red_first : {true, false}) {
        SolidRaster raster(kBox, 1);
        const SolidMesh near = square(0.5, 0.2, red), far = square(-0.5, 0.4, blue);
        raster.add(red_first ? near : far, camera, 1);
        raster.add(red_first ? far : near, camera, 1);
        const Raster picture = raster.picture();
        const Place both = camera.place({0, 0, 0.3}), blue_only = camera.place({0, 0.3, 0.3});
        const auto at = [&](Place p) {
            return picture.at(static_cast<int>(p.x), static_cast<int>(p.y));
        };
        EXPECT_GT((at(both) >> 16) & 255, 100u);
        EXPECT_GT(at(blue_only) & 255, 100u);
        EXPECT_LT((at(blue_only) >> 16) & 255, 80u);
        EXPECT_EQ(at({2, 2}), 0u);  // nothing: transparent
        // A line between the squares, one before both
        EXPECT_TRUE(raster.hides(both, camera.nearness({0, 0, 0.3})));
        EXPECT_FALSE(raster.hides(both, camera.nearness({0.9, 0, 0.3})));
        EXPECT_FALSE(raster.hides(blue_only, camera.nearness({0, 0.3, 0.3})));
    }
}

TEST(SolidRaster, ATranslucentSurfaceLetsTheOtherThrough) {
    const SolidCamera camera(0, 0, kBox);
    SolidRaster raster(kBox, 1);
    raster.add(square(0.5, 0.2, {1, 0, 0}), camera, 0.5);
    raster.add(square(-0.5, 0.2, {0, 0, 1}), camera, 0.5);
    const Place place = camera.place({0, 0, 0.3});
    const std::uint32_t pixel =
        raster.picture().at(static_cast<int>(place.x), static_cast<int>(place.y));
    EXPECT_NEAR((pixel >> 16) & 255, pixel & 255, 3);
    EXPECT_EQ(pixel >> 24, 255u);
}

}  // namespace
}  // namespace asperity::plots
