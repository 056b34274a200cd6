// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/slope_distribution.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/length_histogram.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

#include <numeric>

namespace asperity {
namespace {

using Histogram = LengthHistogram<12>;

using testing::make;
using testing::settings_of;

TEST(LengthHistogram, BinsHoldTheirLengths) {
    for (const double length : {1e-9, 1e-7, 0.001, 0.3, 0.999, 1.0, 1.0001, 7.5, 1000.0}) {
        const int b = Histogram::bin(length);
        EXPECT_LE(Histogram::lower_end(b), length);
        EXPECT_GT(Histogram::lower_end(b + 1), length);
    }
    EXPECT_EQ(Histogram::bin(0), 0);
    EXPECT_EQ(Histogram::bin(1e300), Histogram::kBins - 1);
}

TEST(LengthHistogram, SharesAreRanks) {
    Histogram histogram;
    for (const double length : {0.5, 1.5, 2.5, 3.5}) histogram.add(length);
    const LengthRanks<12> ranks(histogram);
    EXPECT_EQ(ranks.total(), 4U);
    EXPECT_EQ(ranks.share(1.0), 0.25);
    EXPECT_EQ(ranks.share(3.0), 0.75);
    EXPECT_EQ(ranks.share(0), 0.125);  // half a rank from the ends
    EXPECT_EQ(ranks.share(100), 0.875);
}

TEST(SlopeLaw, CumulativeDistributions) {
    const SlopeLaw beckmann{SlopeFamily::Beckmann, 0.5, 0.25};
    const SlopeLaw ggx{SlopeFamily::Ggx, 0.5, 0.25};
    EXPECT_NEAR(beckmann.stretched_length({0.3, -0.2}), 1.0, 1e-15);  // (0.6, -0.8)
    EXPECT_NEAR(beckmann.cumulative(1), 1 - std::exp(-1.0), 1e-15);
    EXPECT_EQ(ggx.cumulative(1), 0.5);
    EXPECT_EQ(ggx.cumulative(0), 0);
    EXPECT_EQ(ggx.cumulative(std::numeric_limits<double>::infinity()), 1);
}

// All facets of a 45 degree groove have length 1 / alpha: the distance is the larger part of the
// law on either side of it.
TEST(SlopeDistance, OfASingleLength) {
    const Heightfield surface = make(settings_of("vgroove", 32));
    const SlopeLaw law{SlopeFamily::Ggx, 0.5, 0.5};  // F(2) = 0.8
    EXPECT_NEAR(slope_distribution_distance(surface, law, 2), 0.8, 2e-4);
    // Cut at slope 0.5 only lengths up to 1 count: no facet there, the law has F(1) = 0.5
    const SlopeLaw cut{SlopeFamily::Ggx, 0.5, 0.5, 0.5};
    EXPECT_NEAR(slope_distribution_distance(surface, cut, 2), 0.5, 2e-4);
    // Along x a slope cut at 0.75 has length 0.75 / 0.5 = 1.5, along y 3: compared up to the
    // smaller
    const SlopeLaw oblong{SlopeFamily::Ggx, 0.5, 0.25, 0.75};
    EXPECT_NEAR(slope_distribution_distance(surface, oblong, 2), 2.25 / 3.25, 2e-4);
}

// Gaussian facets follow Beckmann but for chance (0.7 L / side on alpha changes F by half of that)
// and are far from GGX: max over r of (1 - exp(-r^2)) - r^2 / (1 + r^2) is 0.204 at r = 1.34.
TEST(SlopeDistance, TellsBeckmannFromGgx) {
    SurfaceSettings settings = settings_of("gaussian", 1024);
    settings.correlation_x = settings.correlation_y = 4;
    const Heightfield surface = make(settings);
    EXPECT_LT(slope_distribution_distance(surface, {SlopeFamily::Beckmann, 0.3, 0.3}, 2), 0.004);
    EXPECT_NEAR(slope_distribution_distance(surface, {SlopeFamily::Ggx, 0.3, 0.3}, 2), 0.2035,
                0.004);
}

TEST(SlopeDistribution, OfPyramidsFillsFourBins) {
    SurfaceSettings settings = settings_of("pyramids", 32);
    settings.tilt_deg = degrees(std::atan(0.5 * std::sqrt(2.0)));  // slopes +-0.5
    const auto d = slope_distribution(make(settings), 1, 4, 2);    // bins of width 0.5
    EXPECT_EQ(d.outside, 0);
    // The slopes are +-0.5, up to rounding, on an edge between bins; each quadrant holds a quarter.
    for (const std::size_t y : {0U, 2U})
        for (const std::size_t x : {0U, 2U}) {
            const double quadrant = d.density[y * 4 + x] + d.density[y * 4 + x + 1] +
                                    d.density[y * 4 + 4 + x] + d.density[y * 4 + 5 + x];
            EXPECT_NEAR(quadrant * 0.25, 0.25, 1e-12);
        }
}

TEST(SlopeDistribution, CountsEveryFacetOnce) {
    SurfaceSettings settings = settings_of("gaussian", 121);
    const Heightfield surface = make(settings);
    const auto d = slope_distribution(surface, 0.4, 20, 2);
    const double inside = std::accumulate(d.density.begin(), d.density.end(), 0.0) * 0.04 * 0.04;
    EXPECT_GT(d.outside, 0);
    EXPECT_NEAR(inside + d.outside, 1, 1e-12);
    EXPECT_EQ(slope_distribution(surface, 0.4, 20, 7).density, d.density);
}

// P22 of a Gaussian surface: exp(-(x^2 + y^2) / alpha^2) / (pi alpha^2).
TEST(SlopeDistribution, OfAGaussianSurface) {
    SurfaceSettings settings = settings_of("gaussian", 1024);
    settings.correlation_x = settings.correlation_y = 4;
    const auto d = slope_distribution(make(settings), 0.6, 12, 2);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
            // Mean of the density over the bin, from error functions
            const auto share = [](int b) {
                const double low = -0.6 + 0.1 * b;
                return (std::erf((low + 0.1) / 0.3) - std::erf(low / 0.3)) / 2;
            };
            EXPECT_NEAR(d.density[static_cast<std::size_t>(y * 12 + x)], share(x) * share(y) * 100,
                        0.2)  // of up to 3.4, six times the standard error
                << x << ' ' << y;
        }
}

TEST(SlopeDistribution, RefusesEmptySquares) {
    const Heightfield surface = testing::flat_grid(4, 4);
    EXPECT_THROW(slope_distribution(surface, 0, 4, 1), Error);
    EXPECT_THROW(slope_distribution(surface, std::nan(""), 4, 1), Error);
    EXPECT_THROW(slope_distribution(surface, 1, 0, 1), Error);
    EXPECT_THROW(slope_distribution(surface, 1, 5000, 1), Error);
}

}  // namespace
}  // namespace asperity
