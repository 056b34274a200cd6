// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/power_spectrum.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

PowerSpectrumSettings gaussian_spectrum(double lx, double ly, int n = 128) {
    PowerSpectrumSettings s;
    s.correlation_x = lx;
    s.correlation_y = ly;
    s.nx = s.ny = n;
    return s;
}

// Neighbours of a field of variance 1 and autocorrelation exp(-x^2/L^2) differ by the variance
// 2 (1 - exp(-1/L^2)). The variance here includes the mean, which variances() leaves out.
TEST(PowerSpectrum, GaussianNeighboursAreCorrelatedExactly) {
    const asperity::Run run(2);
    for (const double length : {0.3, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        const PowerSpectrum density(gaussian_spectrum(length, 1.7 * length));
        const auto v = density.variances(run);
        const double variance = v.height + density(0, 0);
        const double ly = 1.7 * length;
        EXPECT_NEAR(v.slope_x / variance, 2 * (1 - std::exp(-1 / (length * length))), 1e-12);
        EXPECT_NEAR(v.slope_y / variance, 2 * (1 - std::exp(-1 / (ly * ly))), 1e-12);
    }
}

// At lag x the spectrum must sum to exp(-x^2/L^2) times the variance: its definition.
TEST(PowerSpectrum, GaussianSumsToItsAutocorrelation) {
    const int n = 60;
    const PowerSpectrum density(gaussian_spectrum(3, 3, n));
    for (const int lag : {0, 1, 3, 7}) {
        double at_lag = 0, at_zero = 0;
        for (int kx = 0; kx < n; ++kx)
            for (int ky = 0; ky < n; ++ky) {
                at_lag += density(kx, ky) * std::cos(2 * kPi * kx * lag / n);
                at_zero += density(kx, ky);
            }
        EXPECT_NEAR(at_lag / at_zero, std::exp(-lag * lag / 9.0), 1e-12);
    }
}

TEST(PowerSpectrum, PowerLawsFollowTheirFormula) {
    PowerSpectrumSettings s = gaussian_spectrum(5, 3, 64);
    s.ny = 50;
    s.aspect = 2;
    s.hurst = 0.7;
    // kx = 2 pi 4 / 64, ky = 2 pi 6 / (50 * 2)
    const double x = 2 * kPi * 4 / 64 * 5, y = 2 * kPi * 6 / 100 * 3;
    s.autocorrelation = Autocorrelation::SelfAffine;
    EXPECT_NEAR(PowerSpectrum(s)(4, 6), std::pow(1 + x * x + y * y, -1.7), 1e-14);
    EXPECT_NEAR(PowerSpectrum(s)(64 - 4, 50 - 6), std::pow(1 + x * x + y * y, -1.7), 1e-14);
    s.autocorrelation = Autocorrelation::Exponential;
    EXPECT_NEAR(PowerSpectrum(s)(4, 6), std::pow(1 + x * x + y * y, -1.5), 1e-14);
}

// The same sums over all wave vectors, without using any symmetry.
TEST(PowerSpectrum, VariancesAreTheSumsOverAllWaveVectors) {
    const asperity::Run run(3);
    for (const int nx : {11, 12})
        for (const int ny : {9, 14}) {
            PowerSpectrumSettings s = gaussian_spectrum(2, 3);
            s.autocorrelation = Autocorrelation::SelfAffine;
            s.nx = nx;
            s.ny = ny;
            s.aspect = 0.5;
            const PowerSpectrum density(s);
            double height = 0, slope_x = 0, slope_y = 0;
            for (int kx = 0; kx < nx; ++kx)
                for (int ky = 0; ky < ny; ++ky) {
                    if (kx == 0 && ky == 0) continue;
                    height += density(kx, ky);
                    slope_x += density(kx, ky) * (2 - 2 * std::cos(2 * kPi * kx / nx));
                    slope_y += density(kx, ky) * (2 - 2 * std::cos(2 * kPi * ky / ny)) / 0.25;
                }
            const auto v = density.variances(run);
            EXPECT_NEAR(v.height, height, 1e-12 * height);
            EXPECT_NEAR(v.slope_x, slope_x, 1e-12 * slope_x);
            EXPECT_NEAR(v.slope_y, slope_y, 1e-12 * slope_y);
        }
}

// With the exact variances 1 - exp(-1/L^2) per axis: exp(-1/Ly^2) = 1 - (ay/ax)^2 (1 -
// exp(-1/Lx^2)).
TEST(MatchingCorrelation, AgreesWithTheClosedFormOfTheGaussian) {
    const asperity::Run run(2);
    for (const double ratio : {0.25, 0.5, 0.9, 1.0, 1.5, 3.0}) {
        const double c = ratio * ratio * (1 - std::exp(-1.0 / 36));
        const double expected = 1 / std::sqrt(-std::log(1 - c));
        EXPECT_NEAR(matching_correlation_y(gaussian_spectrum(6, 6, 512), 0.3, 0.3 * ratio, run),
                    expected, 1e-5 * expected)
            << ratio;
    }
}

TEST(MatchingCorrelation, MeetsTheRatioForPowerLawsAndOblongCells) {
    const asperity::Run run(2);
    for (const auto kind : {Autocorrelation::Exponential, Autocorrelation::SelfAffine}) {
        PowerSpectrumSettings s = gaussian_spectrum(8, 8, 200);
        s.autocorrelation = kind;
        s.aspect = 1.3;
        s.correlation_y = matching_correlation_y(s, 0.4, 0.25, run);
        const auto v = PowerSpectrum(s).variances(run);
        EXPECT_NEAR(std::sqrt(v.slope_y / v.slope_x), 0.25 / 0.4, 1e-6);
    }
}

TEST(MatchingCorrelation, RefusesARatioOutOfReach) {
    const asperity::Run run(2);
    try {
        matching_correlation_y(gaussian_spectrum(60, 60, 128), 0.5, 0.001, run);
        ADD_FAILURE() << "accepted";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Usage);
        EXPECT_EQ(e.where(), "alpha");
    }
}

}  // namespace
}  // namespace asperity
