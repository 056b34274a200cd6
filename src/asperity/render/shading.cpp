// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/shading.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

/// The least cosine between the normal that is shaded and the viewer.
constexpr double kLeastCosine = 0.01;

/// The curve of Chiang et al. begins where the triangle's cosine falls below 1 / kSoftPart of the
/// surface's. With 1, theirs, even a fine sphere is too dark by 2 (t tan(theta))^2, t how far a
/// triangle is tilted against it: tenths of a percent ten degrees before the shadow.
constexpr double kSoftPart = 2;

/// `normal`, turned in its plane with `view` until their cosine is kLeastCosine.
Vec3 turn_to_viewer(Vec3 normal, Vec3 view) {
    const Vec3 across = normal - dot(normal, view) * view;
    const double size = length(across);
    if (size < 1e-9) return view;
    return kLeastCosine * view + (std::sqrt(1 - kLeastCosine * kLeastCosine) / size) * across;
}

}  // namespace

ShadingFrame shading_frame(const SurfacePoint& point, Vec3 view) {
    ShadingFrame frame;
    frame.z = point.shading_normal;
    if (dot(frame.z, view) < kLeastCosine) frame.z = turn_to_viewer(frame.z, view);

    // Level: (0, 1, 0) x z
    const Vec3 level{frame.z.z, 0, -frame.z.x};
    const double size = length(level);
    // Close to the vertical the level direction is lost in roundings
    const Vec3 x = size > 1e-6 ? (1 / size) * level : Vec3{1, 0, 0};
    frame.y = normalize(cross(frame.z, x));
    frame.x = cross(frame.y, frame.z);
    return frame;
}

double terminator_softness(const SurfacePoint& point, Vec3 light) {
    const double geometric = dot(point.geometric_normal, light);
    const double shading = dot(point.shading_normal, light);
    const double between = dot(point.geometric_normal, point.shading_normal);
    if (geometric <= 0) return 0;
    // Where the smooth surface turns away it is black by itself
    if (shading <= 0 || between <= 0) return 1;
    const double g = std::min(1.0, kSoftPart * geometric / (shading * between));
    return g * (1 + g * (1 - g));
}

}  // namespace asperity
