// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/camera.h>

#include <asperity/core/error.h>
#include <asperity/render/environment_map.h>
#include <fmt/format.h>

#include <cmath>

namespace asperity {

Camera look_at(Vec3 position, Vec3 target, double fov_deg, Vec3 up) {
    if (!(fov_deg >= 1 && fov_deg <= 170))
        throw Error(ErrorCode::Usage, fmt::format("{} is outside 1 .. 170", fov_deg), "camera-fov");
    const Vec3 view = target - position;
    const double distance = length(view);
    if (!(distance > 0) || !std::isfinite(distance))
        throw Error(ErrorCode::Usage, "the camera stands where it looks to", "camera-target");
    Camera camera;
    camera.position = position;
    camera.fov_deg = fov_deg;
    camera.forward = normalize((1 / distance) * view);

    // Along `up` nothing is left of it: the picture's up is chosen instead.
    constexpr double kAlong = 1e-6;
    const Vec3 sideways = cross(camera.forward, up);
    if (!(length(sideways) > kAlong * length(up)))
        up = dot(camera.forward, up) > 0 ? Vec3{0, 0, 1} : Vec3{0, 0, -1};
    const Vec3 right = normalize(cross(camera.forward, up));
    camera.up = cross(right, camera.forward);
    return camera;
}

Vec3 PixelRays::around(double x, double y) const {
    return map_direction({x / columns_, y * pixel_});
}

}  // namespace asperity
