// SPDX-License-Identifier: Apache-2.0
// The parts of an RGL file: images over the unit square that readers interpolate, and densities
// they warp by. Dupuy and Jakob 2018, "An adaptive parameterization for efficient material
// acquisition and rendering".
#pragma once

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace asperity::io::rgl {

/// A place on the unit square: x = sqrt(2 theta / pi), y = (phi + pi) / (2 pi).
struct Point {
    double x = 0, y = 0;
};

/// Where a direction of polar angle `theta` [0, pi/2] and azimuth `phi`, any, lies on the square.
inline Point to_square(double theta, double phi) {
    const double y = (phi + kPi) / (2 * kPi);
    return {std::sqrt(std::max(0.0, theta) * (2 / kPi)), y - std::floor(y)};
}
inline double theta_of(Point u) {
    return u.x * u.x * (0.5 * kPi);
}
inline double phi_of(Point u) {
    return (2 * u.y - 1) * kPi;
}
/// d(direction) / d(square) [sr]: 2 pi^2 x sin(theta), held off zero as readers do.
inline double solid_angle_of(Point u) {
    return std::max(2 * kPi * kPi * u.x * std::sin(theta_of(u)), 1e-6);
}

/// Up to four slices of a stack and their weights, which sum to 1.
struct Blend {
    std::array<std::size_t, 4> slice{};
    std::array<double, 4> weight{1, 0, 0, 0};
};

/// Linear between the nodes of phi and theta, clamped at the ends; slice = phi * thetas + theta.
/// A single node of phi stands for all.
Blend blend_at(std::span<const float> phis, std::span<const float> thetas, double phi,
               double theta);

/// Images of height x width nodes, at i / (width - 1) and j / (height - 1), both ends included;
/// values[(slice * height + row) * width + column]. Linear between the nodes.
struct Images {
    std::size_t width = 0, height = 0;
    std::vector<float> values;

    double eval(Point u, const Blend& blend) const;
};

/// The same read as densities over the square: every slice is scaled to integrate to 1, and
/// directions are warped from a uniform square and back, rows first. Between slices densities and
/// distributions are blended linearly, as the readers do.
class Density {
  public:
    /// Every slice needs a positive sum; the caller has checked. `before_slice` may throw.
    explicit Density(Images images, const std::function<void()>& before_slice = {});

    struct Warped {
        Point point;
        double density = 0;  ///< per unit square
    };
    Warped sample(Point s, const Blend& blend) const;
    Warped invert(Point u, const Blend& blend) const;
    double eval(Point u, const Blend& blend) const;

  private:
    double at(const std::vector<double>& table, std::size_t slice_size, std::size_t index,
              const Blend& blend) const;

    std::size_t width_, height_;
    std::vector<double> values_;   ///< a slice integrates to 1 in units of patches
    std::vector<double> columns_;  ///< [slice][row][column]: integral along the row up to there
    std::vector<double> rows_;     ///< [slice][row]: integral of the slice up to there
};

}  // namespace asperity::io::rgl
