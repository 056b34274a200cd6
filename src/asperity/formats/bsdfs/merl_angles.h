// SPDX-License-Identifier: Apache-2.0
// Half and difference angles as MERL files count them (Rusinkiewicz 1998).
#pragma once

#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace asperity::io::merl {

inline constexpr int kHalf = 90, kDifference = 90, kAzimuth = 180;

/// theta_half and theta_difference in [0, pi/2], phi_difference in [0, pi) [rad].
struct Angles {
    double half = 0, difference = 0, azimuth = 0;
};

/// wi in the frame in which the half vector is the pole: turned by -phi_h about z, then by -theta_h
/// about y. phi_d and phi_d + pi are one, by reciprocity.
inline Angles angles_of(Vec3 wi, Vec3 wo) {
    const Vec3 h = normalize(wi + wo);
    const double theta = polar_angle(h), phi = azimuth(h);
    const Vec3 w = rotate_z(wi, -phi);
    const double s = std::sin(theta), c = std::cos(theta);
    const Vec3 d = {c * w.x - s * w.z, w.y, s * w.x + c * w.z};
    const double phi_d = std::atan2(d.y, d.x);
    return {theta, polar_angle(d), phi_d < 0 ? phi_d + kPi : phi_d};
}

/// A pair of directions with these angles, the half vector at azimuth 0.
inline std::pair<Vec3, Vec3> directions_of(Angles a) {
    const Vec3 d = from_spherical(a.difference, a.azimuth);
    const double s = std::sin(a.half), c = std::cos(a.half);
    const Vec3 wi = {c * d.x + s * d.z, d.y, -s * d.x + c * d.z};
    return {wi, reflect(wi, {s, 0, c})};
}

/// Cell that readers look a pair up in: no interpolation. theta_half by its square root.
inline std::size_t cell_of(Angles a) {
    const auto bin = [](double x, int bins) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(x * bins), 0, bins - 1));
    };
    const std::size_t h = bin(std::sqrt(std::max(0.0, a.half) / (0.5 * kPi)), kHalf);
    const std::size_t d = bin(a.difference / (0.5 * kPi), kDifference);
    return bin(a.azimuth / kPi, kAzimuth) +
           std::size_t{kAzimuth} * (d + std::size_t{kDifference} * h);
}

/// The middle of a cell; of theta_half the middle of its square root.
inline Angles centre_of(std::size_t cell) {
    const double p = static_cast<double>(cell % kAzimuth) + 0.5;
    const double d = static_cast<double>(cell / kAzimuth % kDifference) + 0.5;
    const double h = (static_cast<double>(cell / kAzimuth / kDifference) + 0.5) / kHalf;
    return {0.5 * kPi * h * h, 0.5 * kPi * d / kDifference, kPi * p / kAzimuth};
}

}  // namespace asperity::io::merl
