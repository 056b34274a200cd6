// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/statistics.h>

#include <asperity/core/directions.h>
#include <asperity/surface/blocks.h>
#include <asperity/surface/facets.h>

#include <cmath>
#include <limits>

namespace asperity {

namespace {

/// Count, mean and central moments (sums of powers 2, 3, 4 about the mean) of some heights.
///
/// Joined by the pairwise formulas of Chan, Golub and LeVeque 1979 and Pebay 2008 (Sandia report
/// SAND2008-6212), which lose no digits where the heights lie far from zero.
struct HeightMoments {
    double count = 0, mean = 0, m2 = 0, m3 = 0, m4 = 0;
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    HeightMoments& operator+=(const HeightMoments& b) {
        if (b.count == 0) return *this;
        const double na = count, nb = b.count, n = na + nb;
        const double d = b.mean - mean, dn = d / n;
        m4 += b.m4 + d * dn * dn * dn * na * nb * (na * na - na * nb + nb * nb) +
              6 * dn * dn * (na * na * b.m2 + nb * nb * m2) + 4 * dn * (na * b.m3 - nb * m3);
        m3 += b.m3 + d * dn * dn * na * nb * (na - nb) + 3 * dn * (na * b.m2 - nb * m2);
        m2 += b.m2 + d * dn * na * nb;
        mean += dn * nb;
        count = n;
        min = std::min(min, b.min);
        max = std::max(max, b.max);
        return *this;
    }
};

/// Moments of one row, in two passes: it stays in the cache.
HeightMoments row_moments(const float* row, int nx) {
    HeightMoments m;
    m.count = nx;
    for (int i = 0; i < nx; ++i) {
        const double h = static_cast<double>(row[i]);
        m.mean += h / nx;
        m.min = std::min(m.min, h);
        m.max = std::max(m.max, h);
    }
    for (int i = 0; i < nx; ++i) {
        const double d = static_cast<double>(row[i]) - m.mean, d2 = d * d;
        m.m2 += d2;
        m.m3 += d2 * d;
        m.m4 += d2 * d2;
    }
    return m;
}

/// Sums over facets.
struct FacetSums {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    double tilt = 0, area = 0;
    double max_square = 0;  ///< of the gradient

    void add(Slope s) {
        const double square = s.x * s.x + s.y * s.y;
        x += s.x;
        y += s.y;
        xx += s.x * s.x;
        yy += s.y * s.y;
        xy += s.x * s.y;
        tilt += std::atan(std::sqrt(square));
        area += std::sqrt(1 + square);
        max_square = std::max(max_square, square);
    }

    FacetSums& operator+=(const FacetSums& o) {
        x += o.x;
        y += o.y;
        xx += o.xx;
        yy += o.yy;
        xy += o.xy;
        tilt += o.tilt;
        area += o.area;
        max_square = std::max(max_square, o.max_square);
        return *this;
    }
};

void set_height_figures(SurfaceStatistics& result, const HeightMoments& m) {
    result.mean_height = m.mean;
    result.min_height = m.min;
    result.max_height = m.max;
    if (m.min == m.max) return;
    const double variance = m.m2 / m.count;
    result.rms_height = std::sqrt(variance);
    result.skewness = m.m3 / m.count / (variance * result.rms_height);
    result.kurtosis = m.m4 / m.count / (variance * variance);
}

void set_slope_figures(SurfaceStatistics& result, const FacetSums& f, double facets) {
    result.mean_slope_x = f.x / facets;
    result.mean_slope_y = f.y / facets;
    result.rms_slope_x = std::sqrt(f.xx / facets);
    result.rms_slope_y = std::sqrt(f.yy / facets);
    result.rms_gradient = std::sqrt((f.xx + f.yy) / facets);
    result.alpha_x = std::sqrt(2.0) * result.rms_slope_x;
    result.alpha_y = std::sqrt(2.0) * result.rms_slope_y;
    const double var_x = f.xx / facets - result.mean_slope_x * result.mean_slope_x;
    const double var_y = f.yy / facets - result.mean_slope_y * result.mean_slope_y;
    const double cov = f.xy / facets - result.mean_slope_x * result.mean_slope_y;
    // Below this, a variance is the rounding of a constant slope
    const double noise = 1e-12 * (f.xx + f.yy) / facets;
    if (var_x > noise && var_y > noise) result.slope_correlation = cov / std::sqrt(var_x * var_y);
    result.mean_tilt_deg = degrees(f.tilt / facets);
    result.max_tilt_deg = degrees(std::atan(std::sqrt(f.max_square)));
    result.area_ratio = f.area / facets;
}

}  // namespace

SurfaceStatistics statistics(const Heightfield& surface, const Run& run) {
    const auto add_heights = [&](HeightMoments& part, int j) {
        throw_if_stopped(run);
        const auto offset = static_cast<std::size_t>(j) * static_cast<std::size_t>(surface.nx);
        part += row_moments(surface.heights.data() + offset, surface.nx);
    };
    const auto add_facets = [&](FacetSums& part, int j) {
        throw_if_stopped(run);
        visit_facets(surface, j, [&](int, Triangle, Slope s) { part.add(s); });
    };
    SurfaceStatistics result;
    set_height_figures(result, sum_rows<HeightMoments>(surface.ny, run.threads(), add_heights));
    set_slope_figures(result, sum_rows<FacetSums>(surface.cells_y(), run.threads(), add_facets),
                      2.0 * static_cast<double>(surface.cell_count()));
    return result;
}

}  // namespace asperity
