// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/surface_settings.h>

#include <vector>

namespace asperity {

/// Which power spectrum, on which grid. Lengths in units of dx; the cell is 1 x `aspect`.
struct PowerSpectrumSettings {
    Autocorrelation autocorrelation = Autocorrelation::Gaussian;
    double hurst = 0.8;  ///< self-affine only
    double correlation_x = 8, correlation_y = 8;
    int nx = 0, ny = 0;
    double aspect = 1;  ///< dy / dx
};

/// Power spectral density of a periodic random height field on a grid, up to a constant factor.
///
/// With wave numbers kx = 2 pi m / nx, ky = 2 pi n / (ny aspect):
/// - Gaussian: the exact transform of the sampled autocorrelation exp(-x^2/Lx^2 - y^2/Ly^2), which
///   by Poisson's summation is, per axis, the sum over all aliases of exp(-(k L / 2)^2). Neighbours
///   on the grid are therefore correlated by exactly exp(-1/L^2), also for short L.
/// - SelfAffine: (1 + (kx Lx)^2 + (ky Ly)^2)^-(1 + H) up to the grid's own cut-off: the
/// K-correlation
///   model (Palasantzas, Phys. Rev. B 48 (1993) 14472), a power law k^-2(1+H) that rolls off at
///   1/L.
/// - Exponential: the same with H = 1/2, the two-dimensional transform of exp(-r/L).
class PowerSpectrum {
  public:
    explicit PowerSpectrum(const PowerSpectrumSettings& settings);

    /// Density at 0 <= kx < nx, 0 <= ky < ny; symmetric under kx -> nx - kx and ky -> ny - ky.
    double operator()(int kx, int ky) const;

    /// Variances of a field of this spectrum without its mean: Parseval sums over all wave vectors
    /// but zero. Exact for the grid: slopes are those along the edges of the cells, and so those of
    /// the facets, |exp(i k) - 1|^2 = 4 sin^2(k / 2) per unit of density.
    struct Variances {
        double height = 0, slope_x = 0, slope_y = 0;
        Variances& operator+=(const Variances& other);
    };
    Variances variances(const Run& run) const;

  private:
    PowerSpectrumSettings settings_;
    double exponent_ = 0;
    std::vector<double> x_, y_;  // per |kx|, |ky|: factors of the density, or (k L)^2
};

/// The correlation length along y for which the facet slopes of the spectrum have the ratio
/// alpha_y / alpha_x, correlation_x being kept. Solved on the exact sums of PowerSpectrum.
///
/// Throws Error(Usage, "alpha") when no length between 0.1 and the size of the tile gives it.
double matching_correlation_y(const PowerSpectrumSettings& settings, double alpha_x, double alpha_y,
                              const Run& run);

}  // namespace asperity
