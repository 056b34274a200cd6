// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/surface/slope_distribution.h>

namespace asperity {

/// Statistics of a rough surface in Smith's sense: how its facets are tilted and how much they hide
/// each other.
///
/// alpha_x, alpha_y > 0 are the widths of the slope distribution along x and y; for Beckmann alpha
/// = sqrt(2) x rms slope along that axis. Formulas after Heitz 2014, "Understanding the
/// masking-shadowing function in microfacet-based BRDFs", JCGT 3(2), equations by their number
/// there. Directions are unit vectors with z > 0 unless said otherwise.
struct SmithSurface {
    SlopeFamily distribution = SlopeFamily::Ggx;
    double alpha_x = 0.5, alpha_y = 0.5;

    /// D(wm) [1/sr]: area of facets with normal wm per projected area; D cos(theta_m) integrates
    /// to 1. Beckmann eq. 80, GGX eq. 85. 0 for wm.z <= 0.
    double normal_density(Vec3 wm) const;

    /// Lambda(w): hidden over visible projected area of the facets. Beckmann eq. 83 with erf exact,
    /// GGX eq. 86. 0 along the normal, infinite at the horizon (w.z = 0).
    double lambda(Vec3 w) const;

    /// Share of the facets turned towards w that w sees, 1 / (1 + Lambda), eq. 53.
    double g1(Vec3 w) const { return 1 / (1 + lambda(w)); }

    /// Density of the facet normals that w sees [1/sr]: G1(w) max(0, w . wm) D(wm) / w.z, eq. 17.
    double visible_normal_density(Vec3 w, Vec3 wm) const;

    /// Draws a facet normal that w sees, w.z > 0, with visible_normal_density, from two numbers in
    /// [0, 1). GGX: Heitz 2018, "Sampling the GGX distribution of visible normals", JCGT 7(4).
    /// Beckmann: the slopes one after the other (Heitz and d'Eon 2014), the first by inverting its
    /// cumulative distribution (as Jakob 2014, "An improved visible normal sampling routine for the
    /// Beckmann distribution").
    Vec3 sample_visible_normal(Vec3 w, double u1, double u2) const;
};

/// Inverse of the error function on (-1, 1), to double precision.
double inverse_erf(double y);

}  // namespace asperity
