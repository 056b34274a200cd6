// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/camera.h>

#include <asperity/core/error.h>
#include <asperity/render/render_testing.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace asperity {
namespace {

using test::expect_near;

TEST(Camera, LooksAtItsTargetWithUpOrthogonal) {
    const Camera camera = look_at({1, 2, 3}, {1, -2, 0}, 40);
    expect_near(camera.forward, {0, -0.8, -0.6});
    expect_near(camera.up, {0, 0.6, -0.8});
    expect_near(camera.right(), {1, 0, 0});
    EXPECT_EQ(camera.fov_deg, 40);
    EXPECT_EQ(camera.position, (Vec3{1, 2, 3}));
}

TEST(Camera, AlongUpThePictureStillHasAnUp) {
    const Camera down = look_at({0, 5, 0}, {0, 0, 0}, 40);
    expect_near(down.forward, {0, -1, 0});
    expect_near(down.up, {0, 0, -1});
    const Camera up = look_at({0, -5, 0}, {0, 0, 0}, 40);
    expect_near(up.up, {0, 0, 1});
}

TEST(Camera, RefusesWhatCannotBe) {
    const auto where = [](Vec3 position, Vec3 target, double fov) {
        try {
            look_at(position, target, fov);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            return error.where();
        }
        return std::string();
    };
    EXPECT_EQ(where({1, 1, 1}, {1, 1, 1}, 40), "camera-target");
    EXPECT_EQ(where({1, std::nan(""), 1}, {1, 1, 1}, 40), "camera-target");
    EXPECT_EQ(where({0, 0, 1}, {0, 0, 0}, 0.9), "camera-fov");
    EXPECT_EQ(where({0, 0, 1}, {0, 0, 0}, 170.1), "camera-fov");
    EXPECT_EQ(where({0, 0, 1}, {0, 0, 0}, std::nan("")), "camera-fov");
    EXPECT_EQ(where({0, 0, 1}, {0, 0, 0}, 170), "");
}

// Thesis eq. 4.5: -z in the middle, +x to the right of it, +y along the upper edge.
TEST(PixelRays, OfAPanoramaGoEverywhere) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.panorama = true;
    const PixelRays rays(camera, 400, 200);
    EXPECT_EQ(rays.at(7, 9).origin, (Vec3{1, 2, 3}));
    expect_near(rays.at(200, 100).direction, {0, 0, -1});
    expect_near(rays.at(300, 100).direction, {1, 0, 0});
    expect_near(rays.at(100, 100).direction, {-1, 0, 0});
    expect_near(rays.at(0, 100).direction, {0, 0, 1});
    expect_near(rays.at(123, 0).direction, {0, 1, 0});
    expect_near(rays.at(300, 150).direction, normalize({1, -1, 0}));
}

// From edge to edge the picture is 2 tan(fov / 2) high at distance 1, and wide in proportion.
TEST(PixelRays, ReachTheEdgesOfTheField) {
    const Camera camera = look_at({0, 0, 2}, {0, 0, 0}, 90);
    const PixelRays rays(camera, 200, 100);
    expect_near(rays.at(100, 50).direction, {0, 0, -1});
    EXPECT_EQ(rays.at(100, 50).origin, (Vec3{0, 0, 2}));
    expect_near(rays.at(100, 0).direction, normalize({0, 1, -1}));
    expect_near(rays.at(100, 100).direction, normalize({0, -1, -1}));
    expect_near(rays.at(0, 50).direction, normalize({-2, 0, -1}));
    expect_near(rays.at(200, 50).direction, normalize({2, 0, -1}));
}

}  // namespace
}  // namespace asperity
