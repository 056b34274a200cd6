// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/models/microfacet.h>

namespace asperity {

/// Smallest (excluded) and largest tail exponent of StudentTFacets: at 3/2 the mean slope becomes
/// infinite and the facets hide each other wholly; at 1000 the slopes are Beckmann's to 0.1 %.
inline constexpr double kLeastGamma = 1.5, kLargestGamma = 1000;

/// Facets with slopes of Student's t-distribution: Ribardiere, Bringier, Meneveaux and Simonot
/// 2017, "STD: Student's t-distribution of slopes for microfacet based BSDFs", Computer Graphics
/// Forum 36(2). With slopes s stretched to alpha = 1,
///
///     P22(s) = (1 + |s|^2 / (gamma - 1))^-gamma / pi,
///
/// which is GGX's for gamma = 2 and tends to Beckmann's as gamma grows. Members as in SmithSurface.
/// Along an axis s sqrt(2) follows Student's t with 2 (gamma - 1) degrees of freedom, whose tail is
/// an incomplete beta function: Lambda takes about a microsecond, a sample about twenty.
class StudentTFacets {
  public:
    /// alpha_x, alpha_y > 0. Throws Error(Usage, "gamma") outside kLeastGamma .. kLargestGamma.
    StudentTFacets(double alpha_x_width, double alpha_y_width, double gamma_exponent);

    double alpha_x, alpha_y, gamma;

    double normal_density(Vec3 wm) const;
    double lambda(Vec3 w) const;
    double g1(Vec3 w) const { return 1 / (1 + lambda(w)); }
    double visible_normal_density(Vec3 w, Vec3 wm) const;
    /// By inverting two cumulative distributions: of the slope in the plane of incidence, seen from
    /// w, then of the slope across it.
    Vec3 sample_visible_normal(Vec3 w, double u1, double u2) const;

  private:
    double tail(double x) const;         ///< share of slopes along an axis above x >= 0, alpha = 1
    double tail_moment(double x) const;  ///< integral of s over the slopes s > x along an axis
    double visible_slope(double sin_theta, double cos_theta, double u) const;
    double slope_across(double along, double u) const;

    double a_;     ///< gamma - 1
    double peak_;  ///< density along an axis at slope 0, alpha = 1
};

/// The microfacet model with these facets.
using StudentTBrdf = MicrofacetModel<StudentTFacets>;

}  // namespace asperity
