// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <algorithm>
#include <numbers>

namespace asperity {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) {
    return degrees * (kPi / 180.0);
}

constexpr double degrees(double radians) {
    return radians * (180.0 / kPi);
}

/// Unit vector at polar angle `theta` from +z and azimuth `phi` from +x towards +y [rad].
inline Vec3 from_spherical(double theta, double phi) {
    const double s = std::sin(theta);
    return {s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
}

/// Polar angle of the unit vector `w` from +z, in [0, pi]; accurate also near the poles.
inline double polar_angle(Vec3 w) {
    return std::atan2(std::hypot(w.x, w.y), w.z);
}

/// Azimuth of `w` in [0, 2 pi); 0 at the pole.
inline double azimuth(Vec3 w) {
    if (w.x == 0 && w.y == 0) return 0;  // atan2 would look at the signs of the zeros
    const double phi = std::atan2(w.y, w.x);
    const double wrapped = phi < 0 ? phi + 2 * kPi : phi;
    return wrapped < 2 * kPi ? wrapped : 0.0;
}

/// Mirrors `w`, pointing away from the surface, about the unit normal `wm`: the result points away
/// too.
constexpr Vec3 reflect(Vec3 w, Vec3 wm) {
    return 2.0 * dot(w, wm) * wm - w;
}

/// Turns `w` about +z by `phi` [rad], counter-clockwise seen from +z.
inline Vec3 rotate_z(Vec3 w, double phi) {
    const double c = std::cos(phi), s = std::sin(phi);
    return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
}

}  // namespace asperity
