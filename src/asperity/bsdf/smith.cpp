// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/smith.h>
#include <asperity/core/directions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {
namespace {

const double kSqrtPi = std::sqrt(kPi);

/// A normal that the stretched direction `v` sees on a GGX surface of alpha = 1, which is a
/// hemisphere: a uniform point of its projection along `v` (Heitz 2018, section 3.2).
Vec3 sample_unit_ggx(Vec3 v, double u1, double u2) {
    const double length_xy = std::hypot(v.x, v.y);
    const Vec3 t1 = length_xy > 0 ? Vec3{-v.y / length_xy, v.x / length_xy, 0} : Vec3{1, 0, 0};
    const Vec3 t2 = cross(v, t1);

    // A disk whose one half is squeezed to what is left of the base of the hemisphere.
    const double r = std::sqrt(u1), phi = 2 * kPi * u2;
    const double p1 = r * std::cos(phi);
    const double squeeze = 0.5 * (1 + v.z);
    const double p2 =
        (1 - squeeze) * std::sqrt(std::max(0.0, 1 - p1 * p1)) + squeeze * r * std::sin(phi);

    // Up onto the hemisphere.
    const double p3 = std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2));
    return p1 * t1 + p2 * t2 + p3 * v;
}

/// Slope in the plane of incidence that the direction (sin, 0, cos) sees on a Beckmann surface of
/// alpha = 1. Its density is (cos - x sin) exp(-x^2) for x sin < cos, so its cumulative
/// distribution, times a constant, is
///     C(x) = cos (1 + erf x) + sin exp(-x^2) / sqrt(pi).
double sample_visible_beckmann_slope(double sin_theta, double cos_theta, double u) {
    const auto cumulative = [&](double x) {
        return cos_theta * std::erfc(-x) + sin_theta * std::exp(-x * x) / kSqrtPi;
    };
    // Slopes beyond +-6 have a share below 1e-16.
    double low = -6, high = sin_theta * 6 > cos_theta ? cos_theta / sin_theta : 6;
    const double target = u * cumulative(high);
    // Newton's steps, halving the bracket instead wherever they leave it.
    double x = 0.5 * (low + high);
    for (int step = 0; step < 100; ++step) {
        const double error = cumulative(x) - target;
        (error > 0 ? high : low) = x;
        const double slope = 2 / kSqrtPi * std::exp(-x * x) * (cos_theta - x * sin_theta);
        double next = x - error / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        // Newton's error is about the square of its last step.
        const bool done = std::abs(next - x) < 1e-9;
        x = next;
        if (done) break;
    }
    return x;
}

/// As sample_unit_ggx, for a Beckmann surface of alpha = 1.
Vec3 sample_unit_beckmann(Vec3 v, double u1, double u2) {
    const double sin_theta = std::hypot(v.x, v.y);
    const double along = sample_visible_beckmann_slope(sin_theta, v.z, u1);
    // Across the plane of incidence the slope is as it is on the whole surface.
    const double across = inverse_erf(std::clamp(2 * u2 - 1, -1 + 1e-16, 1 - 1e-16));
    const double c = sin_theta > 0 ? v.x / sin_theta : 1, s = sin_theta > 0 ? v.y / sin_theta : 0;
    return {-(c * along - s * across), -(s * along + c * across), 1};
}

}  // namespace

double SmithSurface::normal_density(Vec3 wm) const {
    if (wm.z <= 0) return 0;
    const double x = wm.x / alpha_x, y = wm.y / alpha_y, z2 = wm.z * wm.z;
    const double area = kPi * alpha_x * alpha_y;
    if (distribution == SlopeFamily::Ggx) {
        const double t = x * x + y * y + z2;
        return 1 / (area * t * t);
    }
    return std::exp(-(x * x + y * y) / z2) / (area * z2 * z2);
}

double SmithSurface::lambda(Vec3 w) const {
    if (w.z <= 0) return std::numeric_limits<double>::infinity();
    const double x = alpha_x * w.x, y = alpha_y * w.y;
    const double alpha_sin = std::sqrt(x * x + y * y);
    if (alpha_sin == 0) return 0;
    const double a = w.z / alpha_sin;  // 1 / (alpha tan theta)
    if (distribution == SlopeFamily::Ggx) {
        // (-1 + sqrt(1 + 1 / a^2)) / 2, without cancellation for large a.
        const double t = 1 / a;
        return 0.5 * t * (t / (1 + std::hypot(1.0, t)));
    }
    return 0.5 * (std::exp(-a * a) / (a * kSqrtPi) - std::erfc(a));
}

double SmithSurface::visible_normal_density(Vec3 w, Vec3 wm) const {
    if (w.z <= 0) return 0;
    return g1(w) * std::max(0.0, dot(w, wm)) * normal_density(wm) / w.z;
}

Vec3 SmithSurface::sample_visible_normal(Vec3 w, double u1, double u2) const {
    // Stretch to alpha = 1, sample there, and stretch the slopes back.
    const Vec3 stretched = normalize({alpha_x * w.x, alpha_y * w.y, w.z});
    const Vec3 m = distribution == SlopeFamily::Ggx ? sample_unit_ggx(stretched, u1, u2)
                                                    : sample_unit_beckmann(stretched, u1, u2);
    return normalize({alpha_x * m.x, alpha_y * m.y, std::max(0.0, m.z)});
}

double inverse_erf(double y) {
    // Winitzki's formula, good to 2e-3, then Newton's steps on erf; Halley's correction -x makes
    // them converge cubically.
    const double log_term = std::log((1 - y) * (1 + y));
    const double t = 2 / (kPi * 0.147) + 0.5 * log_term;
    double x = std::copysign(std::sqrt(std::max(0.0, std::sqrt(t * t - log_term / 0.147) - t)), y);
    for (int step = 0; step < 3; ++step) {
        // erfc keeps its digits in the tails.
        const double error = y < 0 ? std::erfc(-x) - (1 + y) : (1 - y) - std::erfc(x);
        const double newton = error / (2 / kSqrtPi * std::exp(-x * x));
        x -= newton / (1 + x * newton);
    }
    return x;
}

}  // namespace asperity
