// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <limits>
#include <vector>

namespace asperity {

/// Shape of a distribution of microfacet slopes.
enum class SlopeFamily { Beckmann, Ggx };

/// A law of facet slopes: the slope stretched to s = (slope_x / alpha_x, slope_y / alpha_y) has a
/// uniform azimuth, and its length r the cumulative distribution
/// - Beckmann: 1 - exp(-r^2), a Gaussian of standard deviation alpha / sqrt2 per axis;
/// - Ggx: r^2 / (1 + r^2), no finite variance.
/// Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces", section
/// 5.2 (sampling equations 28 and 35, with tan theta_m = alpha r); anisotropy by stretching: Heitz
/// 2014, "Understanding the masking-shadowing function", JCGT 3(2) (stretch invariance).
struct SlopeLaw {
    SlopeFamily family = SlopeFamily::Ggx;
    double alpha_x = 0.3, alpha_y = 0.3;
    /// Slopes are cut here; beyond, the law is not compared.
    double max_slope = std::numeric_limits<double>::infinity();

    /// Length of the stretched slope.
    double stretched_length(Slope s) const;
    /// Share of the projected area with a stretched length below r >= 0.
    double cumulative(double r) const;
};

/// Kolmogorov-Smirnov distance between the slopes of the facets and a law: the largest difference
/// of the cumulative distributions of the stretched length, over lengths that no cut slope has.
///
/// Every facet counts alike (weighted by projected area). The distance is taken at 4096 lengths an
/// octave, so it can miss at most the share of one such bin, under 2e-4 for both laws. Memory 10
/// MB, besides the surface; same value for any number of threads.
double slope_distribution_distance(const Heightfield& surface, const SlopeLaw& law, int threads);

/// Density of facet slopes over a square, by counting: P22, per unit slope squared, of which
/// D(m) = P22 / cos^4(theta_m) (Heitz 2014, JCGT 3(2), section 2).
struct SlopeDistribution {
    double limit = 0;             ///< the square is [-limit, limit)^2
    int bins = 0;                 ///< per axis
    std::vector<double> density;  ///< density[by * bins + bx], slope_x from -limit upwards with bx
    double outside = 0;           ///< share of the projected area with slopes outside the square
};

/// The density integrated over the square, plus `outside`, is 1. Same bits for any number of
/// threads. Needs limit > 0 and 1 <= bins <= 4096, or throws Error(Usage).
SlopeDistribution slope_distribution(const Heightfield& surface, double limit, int bins,
                                     int threads);

}  // namespace asperity
