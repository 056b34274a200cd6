// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/camera.h>

#include <variant>

namespace asperity {

/// What a user did since the last step: keys that are down, the mouse since then. Table 2.1.
struct CameraInput {
    double seconds = 0;  ///< since the last step, >= 0
    bool w = false, a = false, s = false, d = false, q = false, e = false;
    bool shift = false;  ///< 4 times as fast
    bool ctrl = false;   ///< a quarter as fast; both keys: as fast as without
    bool left_button = false, right_button = false;
    /// How the mouse moved: 1 = the height of the view; x to the right, y down.
    double drag_x = 0, drag_y = 0;
    double scroll = 0;  ///< notches of the wheel, > 0: away from the user, zooms in
};

// The three controllers of table 2.1. step() moves the camera by what the input says; it does
// nothing for an input of zeros. Keys move by speed * seconds: in many small steps or a large one
// the camera comes to the same place. A drag across the height of the view turns by 180 degrees.
// fov_deg is never changed. camera() is always a valid Camera, however long it is steered.

/// Moves round a point and looks at it; the default. Left button: drags the model round, to the
/// right turns it to the right. Wheel: a notch brings the camera a tenth nearer or takes it back.
struct Orbiter {
    Vec3 target{0, 0, 0};
    double distance = 3.5;     ///< > 0, held within 0.01 .. 1000
    double azimuth_deg = 0;    ///< of the camera from +z towards +x, kept in -180 .. 180
    double elevation_deg = 0;  ///< of the camera above the plane of x and z, held in -89.9 .. 89.9
    double fov_deg = 40;

    void step(const CameraInput& input);
    Camera camera() const;
};

/// Walks anywhere. W A S D: forward, left, backward, right, along the view; Q, E: down and up along
/// the world's y. Left button: looks to where the mouse is dragged. The horizon stays level.
struct FirstPerson {
    Vec3 position{0, 0, 3.5};
    double azimuth_deg = 0;    ///< of the view from -z towards +x, kept in -180 .. 180
    double elevation_deg = 0;  ///< of the view above the horizon, held in -89.9 .. 89.9
    double fov_deg = 40;
    double speed = 1;  ///< per second

    void step(const CameraInput& input);
    Camera camera() const;
};

/// Flies with six degrees of freedom. Keys as FirstPerson, Q and E along the camera's own up. Left
/// button: turns about the camera's own up and right. Right button: rolls about the view, to the
/// right clockwise for the user.
struct SixDof {
    Vec3 position{0, 0, 3.5};
    Vec3 forward{0, 0, -1}, up{0, 1, 0};  ///< kept orthonormal
    double fov_deg = 40;
    double speed = 1;  ///< per second

    void step(const CameraInput& input);
    Camera camera() const;
};

using CameraController = std::variant<Orbiter, FirstPerson, SixDof>;

// Each takes over where a camera stands and looks. An orbiter's target lies in front of the camera
// at the depth of `around`; a roll is lost but for SixDof.
Orbiter make_orbiter(const Camera& camera, Vec3 around = {0, 0, 0});
FirstPerson make_first_person(const Camera& camera);
SixDof make_six_dof(const Camera& camera);

}  // namespace asperity
