// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/statistics.h>

#include <asperity/core/directions.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

TEST(Statistics, OfAFlatSurface) {
    Heightfield surface = testing::flat_grid(5, 6);
    std::fill(surface.heights.begin(), surface.heights.end(), 0.1F);
    const auto s = statistics(surface, 2);
    EXPECT_NEAR(s.mean_height, static_cast<double>(0.1F), 1e-15);
    EXPECT_EQ(s.min_height, static_cast<double>(0.1F));
    EXPECT_EQ(s.max_height, static_cast<double>(0.1F));
    EXPECT_EQ(s.rms_height, 0);
    EXPECT_EQ(s.skewness, 0);
    EXPECT_EQ(s.kurtosis, 0);
    EXPECT_EQ(s.rms_gradient, 0);
    EXPECT_EQ(s.slope_correlation, 0);
    EXPECT_EQ(s.max_tilt_deg, 0);
    EXPECT_EQ(s.area_ratio, 1);
}

// Groove of P = 16, 45 degrees: heights 0, 1, .. 8, .. 1. Mean 64 / 16 = 4; mean square
// (2 (1 + 4 + .. + 49) + 64) / 16 = 21.5, so Sq^2 = 5.5; symmetric, so Ssk = 0. About the mean the
// heights are -4, 4 once and -3 .. 3 twice: sum of fourth powers 2 * 256 + 4 (1 + 16 + 81) = 904,
// Sku = 904 / 16 / 5.5^2. All facets have slope (+-1, 0): Sdq = 1, area 1 / cos 45.
TEST(Statistics, OfAGroove) {
    SurfaceSettings settings = settings_of("vgroove", 48);
    const auto s = statistics(make(settings), 2);
    EXPECT_NEAR(s.mean_height, 4, 1e-6);
    EXPECT_NEAR(s.max_height, 8, 1e-6);
    EXPECT_EQ(s.min_height, 0);
    EXPECT_NEAR(s.rms_height, std::sqrt(5.5), 1e-6);
    EXPECT_NEAR(s.skewness, 0, 1e-6);
    EXPECT_NEAR(s.kurtosis, 904.0 / 16 / 30.25, 1e-6);
    EXPECT_NEAR(s.mean_slope_x, 0, 1e-12);
    EXPECT_NEAR(s.rms_slope_x, 1, 1e-6);
    EXPECT_EQ(s.rms_slope_y, 0);
    EXPECT_NEAR(s.rms_gradient, 1, 1e-6);
    EXPECT_NEAR(s.alpha_x, std::sqrt(2.0), 1e-6);
    EXPECT_EQ(s.alpha_y, 0);
    EXPECT_EQ(s.slope_correlation, 0);
    EXPECT_NEAR(s.mean_tilt_deg, 45, 1e-4);
    EXPECT_NEAR(s.max_tilt_deg, 45, 1e-4);
    EXPECT_NEAR(s.area_ratio, std::sqrt(2.0), 1e-6);
}

// Any tilt t: Sdq = tan t, area ratio 1 / cos t.
TEST(Statistics, OfPyramids) {
    for (const double tilt : {0.0, 10.0, 35.0, 70.0}) {
        SurfaceSettings settings = settings_of("pyramids", 32);
        settings.tilt_deg = tilt;
        const auto s = statistics(make(settings), 2);
        EXPECT_NEAR(s.rms_gradient, std::tan(radians(tilt)), 1e-5);
        EXPECT_NEAR(s.alpha_x, std::tan(radians(tilt)), 1e-5);
        EXPECT_NEAR(s.alpha_y, std::tan(radians(tilt)), 1e-5);
        EXPECT_NEAR(s.area_ratio, 1 / std::cos(radians(tilt)), 1e-5);
        EXPECT_NEAR(s.mean_tilt_deg, tilt, 1e-4);
        EXPECT_NEAR(s.slope_correlation, 0, 1e-6);
    }
}

// A sine has Sq = a / sqrt2, Ssk = 0, Sku = (3/8) / (1/4) = 1.5. Its chord over one cell is
// (2 a sin(pi / P)) cos(..), so the RMS slope is sqrt2 a sin(pi / P).
TEST(Statistics, OfASinusoid) {
    SurfaceSettings settings = settings_of("sinusoid", 64);
    settings.period = 32;
    settings.amplitude = 3;
    const auto s = statistics(make(settings), 2);
    EXPECT_NEAR(s.mean_height, 0, 1e-7);
    EXPECT_NEAR(s.rms_height, 3 / std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(s.skewness, 0, 1e-6);
    EXPECT_NEAR(s.kurtosis, 1.5, 1e-6);
    EXPECT_NEAR(s.rms_slope_x, std::sqrt(2.0) * 3 * std::sin(kPi / 32), 1e-6);
    // The eggcrate is two independent sines of half the amplitude: Sq = a / 2, and per axis half
    // the slope of the sinusoid; Sku = (2 * 3/8 + 6 * 1/4) / 16 / (1/4)^2 = 2.25.
    settings.kind = "eggcrate";
    const auto e = statistics(make(settings), 2);
    EXPECT_NEAR(e.rms_height, 1.5, 1e-6);
    EXPECT_NEAR(e.kurtosis, 2.25, 1e-6);
    EXPECT_NEAR(e.rms_slope_x, std::sqrt(0.5) * 3 * std::sin(kPi / 32), 1e-6);
    EXPECT_NEAR(e.rms_slope_y, e.rms_slope_x, 1e-9);
    EXPECT_NEAR(e.slope_correlation, 0, 1e-6);
}

// One spike of height 1 on an n x n tile: mean p = 1 / n^2, and Bernoulli moments: variance
// p (1 - p), Ssk = (1 - 2 p) / sqrt(p (1 - p)), Sku = (1 - 3 p (1 - p)) / (p (1 - p)).
TEST(Statistics, OfASpike) {
    Heightfield surface = testing::flat_grid(40, 40);
    surface.heights[17 * 40 + 23] = 1;
    const auto s = statistics(surface, 2);
    const double p = 1 / 1600.0, q = p * (1 - p);
    EXPECT_NEAR(s.mean_height, p, 1e-15);
    EXPECT_NEAR(s.rms_height, std::sqrt(q), 1e-12);
    EXPECT_NEAR(s.skewness, (1 - 2 * p) / std::sqrt(q), 1e-9);
    EXPECT_NEAR(s.kurtosis, (1 - 3 * q) / q, 1e-7);
    // Six facets touch the spike. Anti diagonal: slopes (1,0), (0,1), (-1,-1) and their opposites.
    EXPECT_NEAR(s.rms_slope_x, std::sqrt(4 / 3200.0), 1e-12);
    EXPECT_NEAR(s.slope_correlation, 0.5, 1e-9);
    EXPECT_NEAR(s.area_ratio, (3194 + 4 * std::sqrt(2.0) + 2 * std::sqrt(3.0)) / 3200, 1e-12);
    EXPECT_NEAR(s.max_tilt_deg, degrees(std::atan(std::sqrt(2.0))), 1e-9);
    // Main diagonal: (1,0), (0,1), (1,-1) and their opposites, with the signs of a valley-ridge
    // pair
    surface.diagonal = Diagonal::Main;
    EXPECT_NEAR(statistics(surface, 2).slope_correlation, -0.5, 1e-9);
}

// A plane tilted along x on a finite patch: mean slope, no variance, no correlation.
TEST(Statistics, OfAPlane) {
    SurfaceSettings settings = settings_of("tilted", 33);
    settings.tilt_deg = 20;
    settings.boundary = Boundary::Finite;
    const auto s = statistics(make(settings), 2);
    EXPECT_NEAR(s.mean_slope_x, std::tan(radians(20)), 1e-6);
    EXPECT_EQ(s.mean_slope_y, 0);
    EXPECT_NEAR(s.max_tilt_deg, 20, 1e-4);
    EXPECT_NEAR(s.mean_tilt_deg, 20, 1e-4);
    EXPECT_EQ(s.slope_correlation, 0);
}

// A far-away zero of height must not cost digits: 1e6 + the groove is still exact in floats.
TEST(Statistics, KeepDigitsFarFromZero) {
    Heightfield surface = make(settings_of("vgroove", 48));
    for (float& h : surface.heights) h = std::round(h) + 1e6F;
    const auto s = statistics(surface, 2);
    EXPECT_NEAR(s.mean_height, 1e6 + 4, 1e-8);
    EXPECT_NEAR(s.rms_height, std::sqrt(5.5), 1e-9);
    EXPECT_NEAR(s.kurtosis, 904.0 / 16 / 30.25, 1e-9);
}

TEST(Statistics, SameBitsForAnyNumberOfThreads) {
    const Heightfield surface = make(settings_of("gaussian", 121));
    const auto one = statistics(surface, 1);
    for (const int threads : {2, 3, 7}) {
        const auto s = statistics(surface, threads);
        EXPECT_EQ(s.mean_height, one.mean_height);
        EXPECT_EQ(s.rms_height, one.rms_height);
        EXPECT_EQ(s.kurtosis, one.kurtosis);
        EXPECT_EQ(s.rms_gradient, one.rms_gradient);
        EXPECT_EQ(s.mean_tilt_deg, one.mean_tilt_deg);
        EXPECT_EQ(s.area_ratio, one.area_ratio);
    }
}

}  // namespace
}  // namespace asperity
