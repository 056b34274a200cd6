// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/slope_distribution.h>

#include <optional>
#include <vector>

namespace asperity {

/// The distribution of normals along the polar angle, the mean over the azimuth.
///
/// density[t] [1/sr] is the cosine-weighted mean of D(m) over theta_m from t to t + 1 of `bins`
/// equal parts of [0, pi/2]: rows of surface/normal_distribution.h with one column.
struct NormalProfile {
    std::vector<double> density;

    int bins() const { return static_cast<int>(density.size()); }
    double theta_edge(int t) const;  ///< [rad]
    double theta_centre(int t) const { return 0.5 * (theta_edge(t) + theta_edge(t + 1)); }
};

/// Counts the facets of `surface`, on the threads of `run` and with the same bits for any number of
/// them. Throws Error(Usage, "bins") unless 1 <= bins <= 4096, Error(Stopped) within milliseconds.
NormalProfile normal_profile(const Heightfield& surface, int bins, const Run& run);

/// The same means of the law's D, alpha_x = alpha_y = `alpha` > 0: exact, from its cumulative
/// distribution.
NormalProfile normal_profile(SlopeFamily family, double alpha, int bins);

/// The same means of a model's D, by the midpoint rule; none when the model has no facets. Relative
/// error below 1e-3 of the highest density as long as the slopes are as wide as a tenth of a bin.
/// Throws Error(Usage, "bins"), Error(Stopped).
std::optional<NormalProfile> normal_profile(const Bsdf& model, int bins, const Run& run);

}  // namespace asperity
