// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/facets.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/make_surface.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

/// What the tests of this folder share.
namespace asperity::testing {

/// Settings of a kind, with the given size and the defaults for the rest.
inline SurfaceSettings settings_of(const std::string& kind, int size) {
    SurfaceSettings s;
    s.kind = kind;
    s.size = size;
    return s;
}

inline Heightfield make(const SurfaceSettings& settings, int threads = 2) {
    Run run(threads);
    return make_surface(settings, run);
}

/// A periodic surface of zero height.
inline Heightfield flat_grid(int nx, int ny) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    s.heights.assign(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0.0F);
    return s;
}

/// The slopes of all facets, Lower then Upper of each cell, row by row.
inline std::vector<Slope> all_slopes(const Heightfield& surface) {
    std::vector<Slope> slopes;
    for (int j = 0; j < surface.cells_y(); ++j)
        visit_facets(surface, j, [&](int, Triangle, Slope s) { slopes.push_back(s); });
    return slopes;
}

/// Upper point of the chi-square distribution at significance 0.001 (Wilson and Hilferty 1931).
inline double chi_square_limit(double degrees_of_freedom) {
    const double z = 3.0902, c = 2 / (9 * degrees_of_freedom);
    return degrees_of_freedom * std::pow(1 - c + z * std::sqrt(c), 3);
}

/// Kolmogorov-Smirnov distance of a sample from a cumulative distribution.
template <class Cumulative>
double ks_distance(std::vector<double> sample, const Cumulative& cumulative) {
    std::sort(sample.begin(), sample.end());
    const auto n = static_cast<double>(sample.size());
    double distance = 0;
    for (std::size_t k = 0; k < sample.size(); ++k) {
        const double f = cumulative(sample[k]);
        distance = std::max(
            {distance, f - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - f});
    }
    return distance;
}

/// Limit of the Kolmogorov-Smirnov distance of n independent values at significance 0.001.
inline double ks_limit(std::size_t n) {
    return 1.949 / std::sqrt(static_cast<double>(n));
}

}  // namespace asperity::testing
