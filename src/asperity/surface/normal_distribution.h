// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity {

/// The distribution of facet normals D(m): area of facets with normal m, per unit of projected area
/// and of solid angle [1/sr] (Walter et al. 2007, section 3.1; Heitz 2014, JCGT 3(2), section 2).
///
/// Tabulated as means over cells equal in theta_m over [0, pi/2] and in phi_m over [0, 2 pi), each
/// weighted by cos(theta_m). Normalised: integral of D(m) cos(theta_m) dm = 1, exactly.
struct NormalDistribution {
    int theta_bins = 0, phi_bins = 0;
    std::vector<double> density;  ///< density[t * phi_bins + p]; row 0 touches z

    /// Integral of cos(theta_m) over a cell of row t [sr]: (sin^2 t2 - sin^2 t1) / 2 dphi.
    double projected_solid_angle(int t) const;
};

/// Counts the facets of `surface`. The normal of a facet of no slope has phi_m = 0. Same bits for
/// any number of threads. Throws Error(Usage) unless both numbers of bins are in 1 .. 4096.
NormalDistribution normal_distribution(const Heightfield& surface, int theta_bins, int phi_bins,
                                       int threads);

/// sigma(w) = integral of D(m) max(0, w . m) dm: area of the facets that face w, projected along w,
/// per unit of projected area of the surface (Heitz 2014, JCGT 3(2), section 2). Never less than
/// cos(theta) = w.z, and equal to it when every facet faces w; their ratio is 1 + Lambda(w), the
/// inverse of Smith's masking.
///
/// Summed over the facets themselves; `w` is a unit vector. Same bits for any number of threads.
double projected_area(const Heightfield& surface, Vec3 w, int threads);

}  // namespace asperity
