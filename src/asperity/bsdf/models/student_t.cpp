// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet_spec.h>
#include <asperity/bsdf/models/student_t.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

#include <Eigen/Core>
#include <unsupported/Eigen/SpecialFunctions>

#include <cmath>
#include <limits>

namespace asperity {
namespace {

double checked_gamma(double gamma) {
    if (!(gamma > kLeastGamma && gamma <= kLargestGamma))
        throw Error(
            ErrorCode::Usage,
            fmt::format("{} is not above {} and at most {}", gamma, kLeastGamma, kLargestGamma),
            "gamma");
    return gamma;
}

/// Half the regularised incomplete beta function: the upper tail at angle phi >= 0 of a density
/// proportional to cos(phi)^(2 p - 1) over -pi/2 .. pi/2.
double angle_tail(double p, double cos_phi) {
    return 0.5 * Eigen::numext::betainc(p, 0.5, cos_phi * cos_phi);
}

/// Gamma(p) / Gamma(p + 1/2).
double gamma_ratio(double p) {
    return std::exp(Eigen::numext::lgamma(p) - Eigen::numext::lgamma(p + 0.5));
}

/// Where the growing function `f` has the value `target` between low and high: Newton's steps,
/// halving the bracket wherever they leave it.
template <class F, class Slope>
double invert(const F& f, const Slope& slope, double target, double low, double high,
              double precision) {
    double x = 0.5 * (low + high);
    for (int step = 0; step < 100; ++step) {
        const double error = f(x) - target;
        (error > 0 ? high : low) = x;
        double next = x - error / slope(x);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        // Newton's error is about the square of its last step.
        const bool done = std::abs(next - x) < precision;
        x = next;
        if (done) break;
    }
    return x;
}

}  // namespace

StudentTFacets::StudentTFacets(double alpha_x_width, double alpha_y_width, double gamma_exponent)
    : alpha_x(alpha_x_width),
      alpha_y(alpha_y_width),
      gamma(checked_gamma(gamma_exponent)),
      a_(gamma - 1),
      peak_(std::sqrt(a_ / kPi) * gamma_ratio(gamma - 0.5)) {}

double StudentTFacets::normal_density(Vec3 wm) const {
    if (wm.z <= 0) return 0;
    // Long before z^4 underflows the normal is horizontal to the last digit.
    const double x = wm.x / alpha_x, y = wm.y / alpha_y, z2 = std::max(wm.z * wm.z, 1e-100);
    const double r2 = (x * x + y * y) / z2;
    return std::exp(-gamma * std::log1p(r2 / a_)) / (kPi * alpha_x * alpha_y * z2 * z2);
}

double StudentTFacets::tail(double x) const {
    return 0.5 * Eigen::numext::betainc(a_, 0.5, a_ / (a_ + x * x));
}

double StudentTFacets::tail_moment(double x) const {
    return peak_ * a_ / (2 * a_ - 1) * std::exp((0.5 - a_) * std::log1p(x * x / a_));
}

double StudentTFacets::lambda(Vec3 w) const {
    if (w.z <= 0) return std::numeric_limits<double>::infinity();
    const double alpha_sin = std::hypot(alpha_x * w.x, alpha_y * w.y);
    if (alpha_sin == 0) return 0;
    // Heitz 2014, eq. 27: the integral of (s - mu) over the slopes s > mu = cot(theta) / alpha,
    // over mu.
    const double mu = w.z / alpha_sin;
    return std::max(0.0, tail_moment(mu) / mu - tail(mu));
}

double StudentTFacets::visible_normal_density(Vec3 w, Vec3 wm) const {
    if (w.z <= 0) return 0;
    return g1(w) * std::max(0.0, dot(w, wm)) * normal_density(wm) / w.z;
}

double StudentTFacets::visible_slope(double sin_theta, double cos_theta, double u) const {
    // Slopes x seen from (sin, 0, cos) have the density (cos - x sin) P(x) for x sin < cos. With
    // x = sqrt(a) tan(phi) even the heaviest tail lies in a bounded interval.
    const double root = std::sqrt(a_);
    const auto cumulative = [&](double phi) {
        const double upper = angle_tail(a_, std::cos(phi));
        return cos_theta * (phi < 0 ? upper : 1 - upper) +
               sin_theta * tail_moment(root * std::tan(phi));
    };
    const auto density = [&](double phi) {
        const double c = std::cos(phi), t = std::tan(phi);
        return (cos_theta - root * t * sin_theta) * peak_ * root *
               std::exp((2 * gamma - 3) * std::log(c));
    };
    // 1e-12 off the horizon stands for all that is steeper.
    const double end = 0.5 * kPi - 1e-12;
    const double high = std::min(end, std::atan2(cos_theta, root * sin_theta));
    return root * std::tan(invert(cumulative, density, u * cumulative(high), -end, high,
                                  1e-10 / (1 + root)));
}

double StudentTFacets::slope_across(double along, double u) const {
    // y = sqrt(a + x^2) tan(psi), with density cos(psi)^(2 gamma - 2): Student's t again, with
    // 2 gamma - 1 degrees of freedom. By its symmetry one tail is enough.
    const double share = std::min(u, 1 - u), p = gamma - 0.5;
    const double peak = 1 / (std::sqrt(kPi) * gamma_ratio(p));
    const auto minus_tail = [&](double psi) { return -angle_tail(p, std::cos(psi)); };
    const auto density = [&](double psi) {
        return peak * std::exp((2 * gamma - 2) * std::log(std::cos(psi)));
    };
    const double psi =
        invert(minus_tail, density, -share, 0, 0.5 * kPi - 1e-12, 1e-10 / (1 + std::sqrt(gamma)));
    const double y = std::sqrt(a_ + along * along) * std::tan(psi);
    return u < 0.5 ? -y : y;
}

Vec3 StudentTFacets::sample_visible_normal(Vec3 w, double u1, double u2) const {
    // Stretch to alpha = 1, sample there, and stretch the slopes back.
    const Vec3 v = normalize({alpha_x * w.x, alpha_y * w.y, w.z});
    const double sin_theta = std::hypot(v.x, v.y);
    const double along = visible_slope(sin_theta, v.z, u1);
    const double across = slope_across(along, u2);
    const double c = sin_theta > 0 ? v.x / sin_theta : 1, s = sin_theta > 0 ? v.y / sin_theta : 0;
    return normalize({-alpha_x * (c * along - s * across), -alpha_y * (s * along + c * across), 1});
}

namespace {

struct StudentTSpec {
    MicrofacetSpec facets;
    double gamma = 3;
};

std::unique_ptr<Bsdf> make_student_t(const StudentTSpec& s) {
    const double alpha_x = s.facets.alpha, alpha_y = s.facets.width_y();
    const OpticsSettings law = s.facets.law();
    std::string name = microfacet_name("student-t", alpha_x, alpha_y,
                                       fmt::format(",gamma={}", s.gamma), s.facets.masking, law);
    return std::make_unique<StudentTBrdf>(
        std::move(name), StudentTFacets(alpha_x, alpha_y, s.gamma), s.facets.masking, law);
}

}  // namespace

BsdfModel student_t_model() {
    using S = StudentTSpec;
    ParamTable<S> table;
    append(table, microfacet_params(), &S::facets);
    table.insert(table.begin() + 1,
                 field(&S::gamma, {.name = "gamma",
                                   .range = {kLeastGamma, kLargestGamma, true},
                                   .doc = "how fast the tails fall: 2 is GGX, large ones tend to "
                                          "Beckmann"}));
    return bsdf_model<S>("student-t", "Student-T",
                         "microfacets with slopes of Student's t-distribution, between GGX and "
                         "Beckmann and beyond (Ribardiere et al. 2017)",
                         std::move(table), make_student_t, {"alpha"});
}

}  // namespace asperity
