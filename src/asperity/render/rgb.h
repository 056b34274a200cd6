// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace asperity {

/// Linear light or reflectance: red, green and blue of the sRGB primaries (Rec. 709), white D65.
struct Rgb {
    double r = 0, g = 0, b = 0;

    friend constexpr Rgb operator+(Rgb c, Rgb d) { return {c.r + d.r, c.g + d.g, c.b + d.b}; }
    friend constexpr Rgb operator-(Rgb c, Rgb d) { return {c.r - d.r, c.g - d.g, c.b - d.b}; }
    friend constexpr Rgb operator*(Rgb c, Rgb d) { return {c.r * d.r, c.g * d.g, c.b * d.b}; }
    friend constexpr Rgb operator*(double s, Rgb c) { return {s * c.r, s * c.g, s * c.b}; }
    friend constexpr bool operator==(Rgb c, Rgb d) = default;
};

/// The Y of CIE XYZ: 1 for white.
constexpr double luminance(Rgb c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

constexpr bool is_black(Rgb c) {
    return c == Rgb{};
}

inline bool is_finite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace asperity
