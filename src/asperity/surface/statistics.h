// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/core/vec.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity {

/// Figures of a surface. Heights are those of the samples, slopes those of the facets, each facet
/// weighted by its projected area (all alike). No form is removed: heights are about their mean,
/// slopes about zero. Height parameters, Sdq and Sdr as ISO 25178-2:2012, 4.1 and 4.3, integrals
/// taken as sums over samples and, exactly, over facets.
struct SurfaceStatistics {
    double mean_height = 0, min_height = 0, max_height = 0;
    double rms_height = 0;  ///< Sq [unit of the surface]
    double skewness = 0;    ///< Ssk; 0 for a flat surface
    double kurtosis = 0;    ///< Sku, 3 for a Gaussian; 0 for a flat surface
    double mean_slope_x = 0, mean_slope_y = 0;
    double rms_slope_x = 0, rms_slope_y = 0;  ///< about zero
    double rms_gradient = 0;  ///< Sdq = sqrt(rms_slope_x^2 + rms_slope_y^2) = Beckmann alpha
    double alpha_x = 0, alpha_y = 0;  ///< sqrt(2) rms_slope_x, sqrt(2) rms_slope_y
    double slope_correlation = 0;  ///< of slope x and slope y over the facets; 0 if one is constant
    double mean_tilt_deg = 0;  ///< mean angle of a facet normal from z, weighted by projected area
    double max_tilt_deg = 0;
    double area_ratio = 1;  ///< true area / projected area = 1 + Sdr
};

/// One pass over the samples and one over the facets, in double precision; same bits for any number
/// of threads. Throws Error(Stopped) within milliseconds once the run is to be stopped.
SurfaceStatistics statistics(const Heightfield& surface, const Run& run);
inline SurfaceStatistics statistics(const Heightfield& surface, int threads) {
    return statistics(surface, Run(threads));
}

}  // namespace asperity
