// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/statistics.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

#include <array>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

// Heights uniform in [0, H], H = 10 r: mean H/2, variance H^2/12, Ssk 0, Sku 9/5. An edge's slope
// is the difference of two: variance H^2/6, so the gradient's is H^2/3. Slopes (a, b) of a facet
// share one sample: for the anti diagonal cov(a, b) = +H^2/12 (Lower: both from (i, j); Upper: both
// to (i+1, j+1)), so the slope along (1, 1)/sqrt2 has variance H^2/4, alpha = sqrt2 H/2 = .7071 H,
// and along (1, -1)/sqrt2 variance H^2/12, alpha = .4082 H. For the main diagonal the sign turns.
TEST(ThesisNoise, HasTheMomentsOfIndependentUniformHeights) {
    for (const double roughness : {0.05, 0.2, 1.0}) {
        SurfaceSettings settings = settings_of("thesis", 1024);
        settings.roughness = roughness;
        const auto s = statistics(make(settings), 2);
        const double h = 10 * roughness;
        // 4 standard errors of 2^20 samples: 4 / 1024 of the standard deviation of each figure
        EXPECT_NEAR(s.mean_height, h / 2, 4 / 1024.0 * h / std::sqrt(12.0));
        EXPECT_NEAR(s.rms_height, h / std::sqrt(12.0), 1.5e-3 * h);
        EXPECT_NEAR(s.skewness, 0, 0.008);
        EXPECT_NEAR(s.kurtosis, 1.8, 0.008);
        EXPECT_NEAR(s.rms_gradient, h / std::sqrt(3.0), 2e-3 * h);
        EXPECT_NEAR(s.slope_correlation, 0.5, 0.005);
        EXPECT_GE(s.min_height, 0);
        EXPECT_LE(s.max_height, h);
        EXPECT_LT(s.min_height, 1e-4 * h);
        EXPECT_GT(s.max_height, (1 - 1e-4) * h);
    }
}

TEST(ThesisNoise, IsAnisotropicAlongTheDiagonals) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        SurfaceSettings settings = settings_of("thesis", 512);
        settings.roughness = 0.5;
        settings.diagonal = diagonal;
        const Heightfield surface = make(settings);
        double along = 0, across = 0;
        const auto slopes = testing::all_slopes(surface);
        for (const Slope s : slopes) {
            along += (s.x + s.y) * (s.x + s.y) / 2;
            across += (s.x - s.y) * (s.x - s.y) / 2;
        }
        const auto n = static_cast<double>(slopes.size());
        double alpha_along = std::sqrt(2 * along / n) / 5,
               alpha_across = std::sqrt(2 * across / n) / 5;
        if (diagonal == Diagonal::Main) std::swap(alpha_along, alpha_across);
        EXPECT_NEAR(alpha_along, std::sqrt(0.5), 0.004);
        EXPECT_NEAR(alpha_across, std::sqrt(1 / 6.0), 0.004);
    }
}

// Heights in 64 equal bins: chi-square of 63 degrees of freedom.
TEST(ThesisNoise, HeightsAreUniform) {
    SurfaceSettings settings = settings_of("thesis", 512);
    settings.roughness = 0.1;
    std::array<double, 64> counts{};
    for (const float h : make(settings).heights)
        ++counts[std::min<std::size_t>(63, static_cast<std::size_t>(h * 64.0F))];
    double chi = 0;
    for (const double count : counts) chi += (count - 4096) * (count - 4096) / 4096;
    EXPECT_LT(chi, testing::chi_square_limit(63));
}

// Lower facets (anti diagonal) of cells of even column and row use samples of their own, so they
// are independent. With heights u, u + a, u + b all in [0, H] the density of (a, b) is the length
// of the interval of u: (H - (max(0, a, b) - min(0, a, b))) / H^3 where positive. H = 1 here.
TEST(ThesisNoise, FacetSlopesFollowTheirDensity) {
    SurfaceSettings settings = settings_of("thesis", 512);
    settings.roughness = 0.1;
    const Heightfield surface = make(settings);
    constexpr int kBins = 8, kFine = 100;
    const auto density = [](double a, double b) {
        return std::max(0.0, 1 - (std::max({0.0, a, b}) - std::min({0.0, a, b})));
    };
    std::array<std::array<double, kBins>, kBins> counts{}, expected{};
    for (int j = 0; j < 512; j += 2)
        for (int i = 0; i < 512; i += 2) {
            const Slope s = facet_slope(surface, i, j, Triangle::Lower);
            ++counts[static_cast<std::size_t>((s.y + 1) * kBins / 2)]
                    [static_cast<std::size_t>((s.x + 1) * kBins / 2)];
        }
    constexpr double kStep = 2.0 / (kBins * kFine);
    for (std::size_t y = 0; y < kBins * kFine; ++y)
        for (std::size_t x = 0; x < kBins * kFine; ++x)
            expected[y / kFine][x / kFine] += density(-1 + (static_cast<double>(x) + 0.5) * kStep,
                                                      -1 + (static_cast<double>(y) + 0.5) * kStep) *
                                              kStep * kStep * 65536;
    double chi = 0, cells = 0;
    for (std::size_t y = 0; y < kBins; ++y)
        for (std::size_t x = 0; x < kBins; ++x) {
            if (expected[y][x] < 1e-3) {
                EXPECT_EQ(counts[y][x], 0);  // slopes no two heights can have
                continue;
            }
            const double d = counts[y][x] - expected[y][x];
            chi += d * d / expected[y][x];
            ++cells;
        }
    EXPECT_GT(cells, 40);
    EXPECT_LT(chi, testing::chi_square_limit(cells - 1));
}

// Heights are independent: on 512^2 samples the correlation at any lag has standard deviation
// 1/512.
TEST(ThesisNoise, NeighboursAreUncorrelated) {
    SurfaceSettings settings = settings_of("thesis", 512);
    settings.roughness = 0.1;
    const auto heights = make(settings).heights;
    for (const std::size_t lag : {1U, 2U, 3U, 4U, 5U, 8U, 16U, 511U, 512U, 513U, 1024U}) {
        double sum = 0;
        for (std::size_t k = 0; k + lag < heights.size(); ++k)
            sum += (static_cast<double>(heights[k]) - 0.5) *
                   (static_cast<double>(heights[k + lag]) - 0.5);
        const auto count = static_cast<double>(heights.size() - lag);
        EXPECT_NEAR(12 * sum / count, 0, 4 / 512.0) << lag;
    }
}

TEST(ThesisNoise, DependsOnTheSeedAlone) {
    SurfaceSettings settings = settings_of("thesis", 250);
    const Heightfield one = make(settings, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(make(settings, threads).heights, one.heights);
    // Seeds n and n + 1 must be unrelated: the correlation of 62,500 samples has sd 0.004
    settings.seed = 2;
    const Heightfield two = make(settings);
    for (const std::size_t shift : {0U, 1U, 250U}) {
        double sum = 0;
        for (std::size_t k = 0; k < 62000; ++k)
            sum += (static_cast<double>(one.heights[k + shift]) - 1) *
                   (static_cast<double>(two.heights[k]) - 1);
        EXPECT_NEAR(sum / 62000 * 3, 0, 0.016) << shift;  // variance of a height is 4/12
    }
}

TEST(ThesisNoise, ZeroRoughnessIsFlat) {
    SurfaceSettings settings = settings_of("thesis", 120);
    settings.roughness = 0;
    const auto s = statistics(make(settings), 2);
    EXPECT_EQ(s.max_height, 0);
    EXPECT_EQ(s.rms_gradient, 0);
}

}  // namespace
}  // namespace asperity
