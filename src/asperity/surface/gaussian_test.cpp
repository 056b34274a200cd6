// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/gaussian.h>

#include <asperity/core/error.h>
#include <asperity/surface/spectrum.h>
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

#include <mutex>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

SurfaceSettings gaussian(int size, double alpha, double length) {
    SurfaceSettings s = settings_of("gaussian", size);
    s.alpha_x = s.alpha_y = alpha;
    s.correlation_x = s.correlation_y = length;
    return s;
}

/// Mean of h(x) h(x + (dx, dy)) over the tile, over the mean square.
double correlation_at(const Heightfield& s, int dx, int dy) {
    double product = 0, square = 0;
    for (int j = 0; j < s.ny; ++j)
        for (int i = 0; i < s.nx; ++i) {
            const double h = static_cast<double>(s.at(i, j));
            product += h * static_cast<double>(s.at((i + dx) % s.nx, (j + dy) % s.ny));
            square += h * h;
        }
    return product / square;
}

TEST(Gaussian, MeetsAlphaOnTheFacets) {
    for (const int size : {120, 121, 250, 512})
        for (const double alpha : {0.05, 0.3, 1.0})
            for (const auto acf : {Autocorrelation::Gaussian, Autocorrelation::Exponential,
                                   Autocorrelation::SelfAffine}) {
                SurfaceSettings settings = gaussian(size, alpha, 6);
                settings.autocorrelation = acf;
                const auto s = statistics(make(settings), 2);
                EXPECT_NEAR(s.rms_gradient, alpha, 1e-6 * alpha);
                EXPECT_NEAR(s.mean_height, 0, 1e-5 * s.rms_height);
            }
}

// Standard errors from the sums of powers of the autocorrelation r = exp(-d^2/L^2) over all lags,
// pi L^2 / p for r^p: var(skewness) = 6 pi L^2 / (3 N), var(kurtosis) = 24 pi L^2 / (4 N);
// L = 4, N = 2^20: 0.0098 and 0.017. Limits are four of them.
TEST(Gaussian, HeightsAreNormal) {
    const auto s = statistics(make(gaussian(1024, 0.3, 4)), 2);
    EXPECT_NEAR(s.skewness, 0, 0.039);
    EXPECT_NEAR(s.kurtosis, 3, 0.068);
}

// Facets eight correlation lengths apart are independent (exp(-64) and less): a proper test on
// 32 x 32 of them, for heights, slopes along x and slopes along y.
TEST(Gaussian, FacetSlopesAreNormalWithVarianceHalfAlphaSquared) {
    const Heightfield surface = make(gaussian(1024, 0.4, 4));
    std::vector<double> x, y;
    for (int j = 0; j < 1024; j += 32)
        for (int i = 0; i < 1024; i += 32) {
            const Slope s = facet_slope(surface, i, j, Triangle::Upper);
            x.push_back(s.x);
            y.push_back(s.y);
        }
    // Cumulative normal distribution of standard deviation alpha / sqrt2
    const auto normal = [](double slope) { return 0.5 * std::erfc(-slope / 0.4); };
    EXPECT_LT(testing::ks_distance(x, normal), testing::ks_limit(x.size()));
    EXPECT_LT(testing::ks_distance(y, normal), testing::ks_limit(y.size()));
}

// Standard error about sqrt(pi L^2 / (2 N)) = 0.007 at L = 8, N = 4 x 512^2... rounded up to 0.01.
TEST(Gaussian, AutocorrelationFallsToOneOverEAtItsLength) {
    for (const auto acf : {Autocorrelation::Gaussian, Autocorrelation::Exponential}) {
        double along_x = 0, along_y = 0;
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
            SurfaceSettings settings = gaussian(512, 0.3, 8);
            settings.autocorrelation = acf;
            settings.seed = seed;
            const Heightfield s = make(settings);
            along_x += correlation_at(s, 8, 0) / 4;
            along_y += correlation_at(s, 0, 8) / 4;
        }
        EXPECT_NEAR(along_x, std::exp(-1.0), 0.04);
        EXPECT_NEAR(along_y, std::exp(-1.0), 0.04);
    }
}

TEST(Gaussian, KeepsLengthsThatDiffer) {
    SurfaceSettings settings = gaussian(1024, 0.3, 12);
    settings.correlation_y = 4;
    const Heightfield surface = make(settings);
    EXPECT_NEAR(correlation_at(surface, 12, 0), std::exp(-1.0), 0.04);
    EXPECT_NEAR(correlation_at(surface, 0, 4), std::exp(-1.0), 0.04);
    const auto s = statistics(surface, 2);
    EXPECT_NEAR(s.rms_gradient, 0.3, 1e-6);
    // alpha_x : alpha_y as the differences of neighbours, (1 - exp(-1/144)) : (1 - exp(-1/16))
    EXPECT_NEAR(s.alpha_y / s.alpha_x, std::sqrt(std::expm1(-1.0 / 16) / std::expm1(-1.0 / 144)),
                0.06);
    EXPECT_FALSE(surface.isotropic);
}

TEST(Gaussian, MeetsAnisotropicAlphas) {
    for (const auto acf : {Autocorrelation::Gaussian, Autocorrelation::SelfAffine}) {
        SurfaceSettings settings = gaussian(1024, 0.4, 4);
        settings.alpha_y = 0.2;
        settings.autocorrelation = acf;
        const auto s = statistics(make(settings), 2);
        // Chance of the tile: 0.7 * 8 / 1024 = 0.5 %
        EXPECT_NEAR(s.alpha_x, 0.4, 0.006);
        EXPECT_NEAR(s.alpha_y, 0.2, 0.006);
        EXPECT_NEAR(s.rms_gradient * s.rms_gradient, (0.16 + 0.04) / 2, 1e-6);
    }
}

// A field of RMS height s and exp(-d^2/L^2): alpha = 2 s / L without the mesh; the facets have
// alpha L sqrt(1 - exp(-1/L^2)) = 2 s sqrt(1 - exp(-1/L^2)). The two slopes of a facet share a
// sample: cov = s^2 (1 - 2 exp(-1/L^2) + exp(-2/L^2)) for the anti diagonal, of variances
// 2 s^2 (1 - exp(-1/L^2)): correlation (1 - exp(-1/L^2)) / 2; the main diagonal turns the sign.
TEST(Gaussian, MeshNarrowsAndTiltsTheSlopesAsDerived) {
    for (const double length : {1.0, 2.0, 4.0})
        for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
            SurfaceSettings settings = gaussian(1024, 0.3, length);
            settings.diagonal = diagonal;
            const auto s = statistics(make(settings), 2);
            const double q = 1 - std::exp(-1 / (length * length));
            const double sign = diagonal == Diagonal::Anti ? 1 : -1;
            EXPECT_NEAR(0.3 / (2 * s.rms_height), std::sqrt(q), 0.01 * std::sqrt(q));
            EXPECT_NEAR(s.slope_correlation, sign * q / 2, 0.015);
        }
}

// |coefficient|^2 over its expectation is exponential of mean 1, for M independent coefficients the
// mean of them is 1 +- 1/sqrt(M); and half the coefficients lie below ln 2.
TEST(Gaussian, SpectrumIsRandomAboutTheDensityAskedFor) {
    for (const auto acf : {Autocorrelation::Exponential, Autocorrelation::SelfAffine}) {
        PowerSpectrumSettings settings;
        settings.autocorrelation = acf;
        settings.nx = 121;
        settings.ny = 250;
        settings.aspect = 1.25;
        settings.correlation_y = 5;
        Heightfield surface = testing::flat_grid(121, 250);
        surface.dy = 1.25;
        asperity::Run run(2);
        fill_gaussian(surface, settings, 0.5, 11, run);

        const PowerSpectrum density(settings);
        const auto v = density.variances(run);
        const double scale = 0.25 / (v.slope_x + v.slope_y) * std::pow(121.0 * 250.0, 2);
        std::mutex mutex;
        double sum = 0, below = 0, count = 0;
        const auto compare = [&](int kx, std::span<std::complex<float>> column) {
            if (kx == 0) return;  // its upper half repeats the lower
            const std::scoped_lock lock(mutex);
            for (int ky = 0; ky < 250; ++ky) {
                const auto c = std::complex<double>(column[static_cast<std::size_t>(ky)]);
                const double power = std::norm(c) / (scale * density(kx, ky));
                sum += power;
                below += power < std::log(2.0) ? 1 : 0;
                ++count;
            }
        };
        filter_spectrum({121, 250, surface.heights}, compare, run);
        EXPECT_EQ(count, 60 * 250);
        EXPECT_NEAR(sum / count, 1, 4 / std::sqrt(count));
        EXPECT_NEAR(below / count, 0.5, 2 / std::sqrt(count));
    }
}

// Columns kx = 0 and kx = nx/2 are their own mirror images; their power must not differ. Over 400
// seeds, the wave vectors (0, 1), (0, n/2), (n/2, 0) of an 8 x 8 field: mean of |c|^2 / expected is
// 1 with standard error 1/20 (complex) and sqrt2/20 (real).
TEST(Gaussian, SelfConjugateCoefficientsHaveFullPower) {
    PowerSpectrumSettings settings;
    settings.nx = settings.ny = 8;
    settings.correlation_x = settings.correlation_y = 0.5;
    const PowerSpectrum density(settings);
    asperity::Run run(1);
    const auto v = density.variances(run);
    const double scale = 1 / (v.slope_x + v.slope_y) * 4096;
    double mean_01 = 0, mean_04 = 0, mean_40 = 0, mean_of_heights = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Heightfield surface = testing::flat_grid(8, 8);
        fill_gaussian(surface, settings, 1, seed, run);
        const auto collect = [&](int kx, std::span<std::complex<float>> c) {
            const auto power = [&](int ky) {
                return std::norm(std::complex<double>(c[static_cast<std::size_t>(ky)])) /
                       (scale * density(kx, ky)) / 400;
            };
            if (kx == 0) {
                mean_of_heights = std::max(mean_of_heights, static_cast<double>(std::abs(c[0])));
                mean_01 += power(1);
                mean_04 += power(4);
            }
            if (kx == 4) mean_40 += power(0);
        };
        filter_spectrum({8, 8, surface.heights}, collect, run);
    }
    EXPECT_NEAR(mean_01, 1, 0.2);
    EXPECT_NEAR(mean_04, 1, 0.28);
    EXPECT_NEAR(mean_40, 1, 0.28);
    EXPECT_LT(mean_of_heights, 1e-4);
}

TEST(Gaussian, SameBitsForAnyNumberOfThreads) {
    for (const int size : {121, 128, 250}) {
        SurfaceSettings settings = gaussian(size, 0.4, 5);
        settings.alpha_y = 0.3;
        settings.autocorrelation = Autocorrelation::SelfAffine;
        const auto reference = make(settings, 1).heights;
        for (const int threads : {2, 3, 7})
            EXPECT_EQ(make(settings, threads).heights, reference) << size << ' ' << threads;
    }
}

// Two independent fields of L = 4 on 512^2: standard deviation of their correlation is
// sqrt(pi L^2 / (2 N)) = 0.0098.
TEST(Gaussian, SeedsAreUnrelated) {
    SurfaceSettings settings = gaussian(512, 0.3, 4);
    const Heightfield one = make(settings);
    for (const std::uint64_t seed : {2ULL, 3ULL, 1ULL << 32}) {
        settings.seed = seed;
        const Heightfield other = make(settings);
        double product = 0, square = 0;
        for (std::size_t k = 0; k < one.heights.size(); ++k) {
            product += static_cast<double>(one.heights[k]) * static_cast<double>(other.heights[k]);
            square += static_cast<double>(one.heights[k]) * static_cast<double>(one.heights[k]);
        }
        EXPECT_NEAR(product / square, 0, 0.04) << seed;
        EXPECT_NE(product, square);
    }
}

TEST(Gaussian, MeetsAlphaOnAFinitePatchAndOnOblongCells) {
    SurfaceSettings settings = gaussian(200, 0.3, 6);
    settings.boundary = Boundary::Finite;
    settings.cell_x = 2;
    settings.cell_y = 3;
    const Heightfield surface = make(settings);
    EXPECT_EQ(surface.cell_count(), 199U * 199U);
    const auto s = statistics(surface, 2);
    EXPECT_NEAR(s.rms_gradient, 0.3, 1e-6);
    EXPECT_NEAR(s.alpha_x, s.alpha_y, 0.04);
}

}  // namespace
}  // namespace asperity
