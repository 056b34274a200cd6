// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/camera_controller.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

constexpr double kTurnDeg = 180;  ///< of a drag across the height of the view
constexpr double kFaster = 4, kSlower = 0.25;
constexpr double kNotch = 0.9;  ///< of the distance is left after a notch of the wheel
constexpr double kNearest = 0.01, kFarthest = 1000;
constexpr double kSteepest = 89.9;  ///< elevation [deg]

double wrap(double angle_deg) {
    return std::remainder(angle_deg, 360.0);
}

double hold_elevation(double angle_deg) {
    return std::clamp(angle_deg, -kSteepest, kSteepest);
}

/// Turns `v` about the unit vector `axis` by `angle` [rad], counter-clockwise seen against the
/// axis: Rodrigues' formula.
Vec3 turn(Vec3 v, Vec3 axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

/// How far the keys move the camera, along its right, up and forward.
Vec3 key_motion(const CameraInput& input, double speed) {
    const auto axis = [](bool plus, bool minus) {
        return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0);
    };
    const double pace = (input.shift ? kFaster : 1) * (input.ctrl ? kSlower : 1);
    const Vec3 along{axis(input.d, input.a), axis(input.e, input.q), axis(input.w, input.s)};
    return (speed * pace * input.seconds) * along;
}

/// Unit vector of a view that is level at elevation 0; azimuth from -z towards +x.
Vec3 view_direction(double azimuth_deg, double elevation_deg) {
    const double a = radians(azimuth_deg), e = radians(elevation_deg);
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

struct ViewAngles {
    double azimuth_deg = 0, elevation_deg = 0;
};

/// Azimuth and elevation of a view, the elevation held. Where the view is upright the azimuth is
/// that of the picture's upper or lower edge.
ViewAngles angles_of(const Camera& camera) {
    constexpr double kUpright = 1e-6;
    const Vec3 f = camera.forward;
    Vec3 level{f.x, 0, f.z};
    if (length(level) < kUpright) level = f.y > 0 ? -camera.up : camera.up;
    return {degrees(std::atan2(level.x, -level.z)),
            hold_elevation(degrees(std::atan2(f.y, std::hypot(f.x, f.z))))};
}

/// The camera at `position` looking level but for its elevation, which must be held.
Camera level_camera(Vec3 position, double azimuth_deg, double elevation_deg, double fov_deg) {
    Camera camera;
    camera.position = position;
    camera.forward = view_direction(azimuth_deg, elevation_deg);
    // Upright, a quarter turn above the view: no cross product that fades near the poles.
    const double a = radians(azimuth_deg), e = radians(elevation_deg);
    camera.up = {-std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a)};
    camera.fov_deg = fov_deg;
    return camera;
}

}  // namespace

void Orbiter::step(const CameraInput& input) {
    if (input.left_button) {
        azimuth_deg = wrap(azimuth_deg - kTurnDeg * input.drag_x);
        elevation_deg = hold_elevation(elevation_deg + kTurnDeg * input.drag_y);
    }
    distance = std::clamp(distance * std::pow(kNotch, input.scroll), kNearest, kFarthest);
}

Camera Orbiter::camera() const {
    // The camera looks back along its own direction from the target.
    const Vec3 view = view_direction(-azimuth_deg, -elevation_deg);
    return level_camera(target - distance * view, -azimuth_deg, -elevation_deg, fov_deg);
}

void FirstPerson::step(const CameraInput& input) {
    if (input.left_button) {
        azimuth_deg = wrap(azimuth_deg + kTurnDeg * input.drag_x);
        elevation_deg = hold_elevation(elevation_deg - kTurnDeg * input.drag_y);
    }
    const Vec3 motion = key_motion(input, speed);
    const Camera now = camera();
    position =
        position + motion.x * now.right() + motion.y * Vec3{0, 1, 0} + motion.z * now.forward;
}

Camera FirstPerson::camera() const {
    return level_camera(position, azimuth_deg, elevation_deg, fov_deg);
}

void SixDof::step(const CameraInput& input) {
    // One turn about one axis of the camera's own: drags of any size along a line end up alike.
    const Vec3 right = cross(forward, up);
    Vec3 axis{};
    if (input.left_button) axis = -input.drag_x * up - input.drag_y * right;
    if (input.right_button) axis = axis + input.drag_x * forward;
    const double drag = length(axis);
    if (drag > 0) {
        axis = (1 / drag) * axis;
        const double angle = radians(kTurnDeg * drag);
        forward = normalize(turn(forward, axis, angle));
        up = turn(up, axis, angle);
        // Rounding must not add up over a long flight.
        up = normalize(up - dot(up, forward) * forward);
    }
    const Vec3 motion = key_motion(input, speed);
    position = position + motion.x * cross(forward, up) + motion.y * up + motion.z * forward;
}

Camera SixDof::camera() const {
    return {position, forward, up, fov_deg};
}

Orbiter make_orbiter(const Camera& camera, Vec3 around) {
    const ViewAngles view = angles_of(camera);
    Orbiter orbiter;
    orbiter.fov_deg = camera.fov_deg;
    orbiter.azimuth_deg = wrap(-view.azimuth_deg);
    orbiter.elevation_deg = -view.elevation_deg;
    orbiter.distance =
        std::clamp(dot(around - camera.position, camera.forward), kNearest, kFarthest);
    orbiter.target =
        camera.position + orbiter.distance * view_direction(view.azimuth_deg, view.elevation_deg);
    return orbiter;
}

FirstPerson make_first_person(const Camera& camera) {
    const ViewAngles view = angles_of(camera);
    FirstPerson walker;
    walker.position = camera.position;
    walker.azimuth_deg = view.azimuth_deg;
    walker.elevation_deg = view.elevation_deg;
    walker.fov_deg = camera.fov_deg;
    return walker;
}

SixDof make_six_dof(const Camera& camera) {
    SixDof flyer;
    flyer.position = camera.position;
    flyer.forward = camera.forward;
    flyer.up = camera.up;
    flyer.fov_deg = camera.fov_deg;
    return flyer;
}

}  // namespace asperity
