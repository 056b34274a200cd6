// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/camera_controller.h>

#include <asperity/core/directions.h>
#include <asperity/core/random.h>
#include <asperity/render/render_testing.h>
#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

using test::expect_near;

void expect_valid(const Camera& camera) {
    EXPECT_NEAR(length(camera.forward), 1, 1e-12);
    EXPECT_NEAR(length(camera.up), 1, 1e-12);
    EXPECT_NEAR(dot(camera.forward, camera.up), 0, 1e-12);
}

CameraInput drag(double x, double y) {
    CameraInput input;
    input.left_button = true;
    input.drag_x = x;
    input.drag_y = y;
    return input;
}

CameraInput roll(double x) {
    CameraInput input;
    input.right_button = true;
    input.drag_x = x;
    return input;
}

/// A step of one second with one key down.
CameraInput key(bool CameraInput::*which, double seconds = 1) {
    CameraInput input;
    input.*which = true;
    input.seconds = seconds;
    return input;
}

template <typename Controller>
Vec3 moved(Controller controller, const CameraInput& input) {
    const Vec3 before = controller.camera().position;
    controller.step(input);
    return controller.camera().position - before;
}

TEST(Orbiter, StartsInFrontOfTheModel) {
    const Camera camera = Orbiter{}.camera();
    expect_near(camera.position, {0, 0, 3.5});
    expect_near(camera.forward, {0, 0, -1});
    expect_near(camera.up, {0, 1, 0});
}

TEST(Orbiter, AnglesAreThoseOfTheCamera) {
    Orbiter orbiter;
    orbiter.target = {1, 2, 3};
    orbiter.distance = 2;
    orbiter.azimuth_deg = 90;
    expect_near(orbiter.camera().position, {3, 2, 3});
    orbiter.elevation_deg = 30;
    expect_near(orbiter.camera().position, {1 + std::sqrt(3.0), 3, 3});
    expect_near(orbiter.camera().forward, normalize(orbiter.target - orbiter.camera().position));
    expect_valid(orbiter.camera());
}

// The model is dragged along: what faced the camera goes where the mouse goes.
TEST(Orbiter, DragTurnsTheModelWithTheMouse) {
    Orbiter orbiter;
    orbiter.step(drag(0.25, 0));
    EXPECT_DOUBLE_EQ(orbiter.azimuth_deg, -45);
    const Camera camera = orbiter.camera();
    EXPECT_GT(dot(Vec3{0, 0, 1}, camera.right()), 0);
    orbiter = {};
    orbiter.step(drag(0, 0.25));
    EXPECT_DOUBLE_EQ(orbiter.elevation_deg, 45);
    EXPECT_LT(dot(Vec3{0, 0, 1}, orbiter.camera().up), 0);
}

TEST(Orbiter, HeedsNoDragWithoutItsButton) {
    Orbiter orbiter;
    CameraInput input = drag(0.5, 0.5);
    input.left_button = false;
    input.w = true;
    input.seconds = 1;
    orbiter.step(input);
    expect_near(orbiter.camera().position, {0, 0, 3.5});
}

TEST(Orbiter, WheelZoomsByATenth) {
    Orbiter orbiter;
    orbiter.distance = 2;
    CameraInput notch;
    notch.scroll = 1;
    orbiter.step(notch);
    EXPECT_DOUBLE_EQ(orbiter.distance, 1.8);
    notch.scroll = -1;
    orbiter.step(notch);
    EXPECT_DOUBLE_EQ(orbiter.distance, 2);
    notch.scroll = 1e4;
    orbiter.step(notch);
    EXPECT_EQ(orbiter.distance, 0.01);
    notch.scroll = -1e9;
    orbiter.step(notch);
    EXPECT_EQ(orbiter.distance, 1000);
}

TEST(Orbiter, StopsAtThePolesAndGoesRound) {
    Orbiter orbiter;
    orbiter.step(drag(0, 3));
    EXPECT_EQ(orbiter.elevation_deg, 89.9);
    expect_valid(orbiter.camera());
    orbiter.step(drag(0, -9));
    EXPECT_EQ(orbiter.elevation_deg, -89.9);
    for (int i = 0; i < 1000; ++i) orbiter.step(drag(0.37, 0));
    EXPECT_GE(orbiter.azimuth_deg, -180);
    EXPECT_LE(orbiter.azimuth_deg, 180);
    EXPECT_NEAR(std::remainder(orbiter.azimuth_deg + 370 * 180, 360), 0, 1e-9);
}

TEST(FirstPerson, KeysMoveAlongTheViewAndTheWorld) {
    FirstPerson walker;
    walker.azimuth_deg = 90;  // looks along +x
    walker.elevation_deg = 30;
    walker.speed = 2;
    const double c = std::sqrt(3.0);
    expect_near(moved(walker, key(&CameraInput::w)), {c, 1, 0});
    expect_near(moved(walker, key(&CameraInput::s)), {-c, -1, 0});
    expect_near(moved(walker, key(&CameraInput::d)), {0, 0, 2});
    expect_near(moved(walker, key(&CameraInput::a)), {0, 0, -2});
    expect_near(moved(walker, key(&CameraInput::e)), {0, 2, 0});
    expect_near(moved(walker, key(&CameraInput::q)), {0, -2, 0});
}

TEST(FirstPerson, LooksToWhereTheMouseGoes) {
    FirstPerson walker;
    walker.step(drag(0.25, 0));
    EXPECT_GT(walker.camera().forward.x, 0.7);
    walker = {};
    walker.step(drag(0, 0.25));
    EXPECT_LT(walker.camera().forward.y, -0.7);
    EXPECT_EQ(walker.camera().right().y, 0);
    walker.step(drag(0, 5));
    EXPECT_EQ(walker.elevation_deg, -89.9);
    expect_valid(walker.camera());
}

TEST(SixDof, KeysMoveAlongItsOwnAxes) {
    SixDof flyer;
    flyer.forward = {1, 0, 0};
    flyer.up = {0, 0, 1};
    expect_near(moved(flyer, key(&CameraInput::w)), {1, 0, 0});
    expect_near(moved(flyer, key(&CameraInput::e)), {0, 0, 1});
    expect_near(moved(flyer, key(&CameraInput::d)), cross(flyer.forward, flyer.up));
}

TEST(SixDof, DragsTurnAndRollIt) {
    SixDof flyer;
    flyer.step(drag(0.5, 0));  // a quarter turn to the right
    expect_near(flyer.forward, {1, 0, 0});
    expect_near(flyer.up, {0, 1, 0});
    flyer = {};
    flyer.step(drag(0, 0.5));  // nose down
    expect_near(flyer.forward, {0, -1, 0});
    expect_near(flyer.up, {0, 0, -1});
    flyer = {};
    flyer.step(roll(0.5));  // clockwise: its up goes to its right
    expect_near(flyer.forward, {0, 0, -1});
    expect_near(flyer.up, {1, 0, 0});
}

TEST(SixDof, StaysOrthonormalOverALongFlight) {
    SixDof flyer;
    const CounterRandom random(7, 0);
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const auto u = random.uniform2(i);
        CameraInput input = drag(u[0] - 0.5, u[1] - 0.5);
        input.right_button = i % 3 == 0;
        input.w = true;
        input.seconds = 0.01;
        flyer.step(input);
    }
    expect_valid(flyer.camera());
}

template <typename Controller>
class WalkersTest : public testing::Test {};
using Walkers = testing::Types<FirstPerson, SixDof>;
TYPED_TEST_SUITE(WalkersTest, Walkers);

TYPED_TEST(WalkersTest, ShiftAndCtrlChangeThePace) {
    TypeParam walker;
    walker.speed = 3;
    CameraInput input = key(&CameraInput::w, 2);
    EXPECT_NEAR(length(moved(walker, input)), 6, 1e-12);
    input.shift = true;
    EXPECT_NEAR(length(moved(walker, input)), 24, 1e-12);
    input.ctrl = true;
    EXPECT_NEAR(length(moved(walker, input)), 6, 1e-12);
    input.shift = false;
    EXPECT_NEAR(length(moved(walker, input)), 1.5, 1e-12);
}

TYPED_TEST(WalkersTest, ManySmallStepsAreOneLargeStep) {
    TypeParam small, large;
    small.step(drag(0.1, 0.05));
    large.step(drag(0.1, 0.05));
    CameraInput input = key(&CameraInput::w, 2);
    input.d = input.e = true;
    large.step(input);
    input.seconds = 2.0 / 1024;
    for (int i = 0; i < 1024; ++i) small.step(input);
    expect_near(small.camera().position, large.camera().position, 1e-11);
}

TYPED_TEST(WalkersTest, OpposedKeysCancel) {
    CameraInput input = key(&CameraInput::w, 2);
    input.s = input.a = input.d = input.q = input.e = true;
    expect_near(moved(TypeParam{}, input), {0, 0, 0});
}

template <typename Controller>
class ControllersTest : public testing::Test {};
using Controllers = testing::Types<Orbiter, FirstPerson, SixDof>;
TYPED_TEST_SUITE(ControllersTest, Controllers);

TYPED_TEST(ControllersTest, ZerosDoNothing) {
    TypeParam controller;
    controller.step(drag(0.1, 0.2));
    const Camera before = controller.camera();
    controller.step({});
    controller.step(drag(0, 0));
    EXPECT_EQ(controller.camera().position, before.position);
    EXPECT_EQ(controller.camera().forward, before.forward);
    EXPECT_EQ(controller.camera().up, before.up);
}

TYPED_TEST(ControllersTest, ManySmallDragsAreOneLargeDrag) {
    TypeParam small, large;
    large.step(drag(0.3, 0.2));
    for (int i = 0; i < 256; ++i) small.step(drag(0.3 / 256, 0.2 / 256));
    expect_near(small.camera().forward, large.camera().forward, 1e-11);
    expect_near(small.camera().up, large.camera().up, 1e-11);
}

TYPED_TEST(ControllersTest, FieldOfViewIsNeverChanged) {
    TypeParam controller;
    controller.fov_deg = 33;
    CameraInput input = drag(0.1, 0.1);
    input.scroll = 3;
    controller.step(input);
    EXPECT_EQ(controller.camera().fov_deg, 33);
}

TEST(TakingOver, EachControllerKeepsTheView) {
    const Camera camera = look_at({2, 1, 3}, {0.5, 0, 0}, 50);
    for (const Camera& taken : {make_orbiter(camera).camera(), make_first_person(camera).camera(),
                                make_six_dof(camera).camera()}) {
        expect_near(taken.position, camera.position);
        expect_near(taken.forward, camera.forward);
        expect_near(taken.up, camera.up);
        EXPECT_EQ(taken.fov_deg, 50);
    }
}

TEST(TakingOver, OrbiterTurnsAboutTheDepthOfThePoint) {
    const Camera camera = look_at({0, 0, 4}, {0, 0, 0}, 40);
    const Orbiter orbiter = make_orbiter(camera, {1, 1, 1});
    EXPECT_NEAR(orbiter.distance, 3, 1e-12);
    expect_near(orbiter.target, {0, 0, 1});
    // A point behind the camera has no depth.
    EXPECT_EQ(make_orbiter(camera, {0, 0, 9}).distance, 0.01);
}

TEST(TakingOver, RollIsKeptBySixDofOnly) {
    SixDof rolled;
    rolled.step(roll(0.1));
    expect_near(make_six_dof(rolled.camera()).up, rolled.up);
    expect_near(make_orbiter(rolled.camera()).camera().up, {0, 1, 0});
    expect_near(make_first_person(rolled.camera()).camera().up, {0, 1, 0});
}

TEST(TakingOver, LookingStraightDownKeepsThePicturesUp) {
    const Camera camera = look_at({0, 5, 0}, {0, 0, 0}, 40);
    const Camera taken = make_orbiter(camera).camera();
    expect_near(taken.position, camera.position);
    expect_near(taken.up, camera.up, 2e-3);  // 89.9 degrees are steepest
    const Camera up = look_at({0, -5, 0}, {0, 0, 0}, 40);
    expect_near(make_first_person(up).camera().up, up.up, 2e-3);
}

}  // namespace
}  // namespace asperity
