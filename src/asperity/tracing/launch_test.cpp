// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/tracing/launch.h>
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace asperity {
namespace {

using test::level_tile;

class LaunchOfEachPattern : public testing::TestWithParam<LaunchPattern> {};
INSTANTIATE_TEST_SUITE_P(Patterns, LaunchOfEachPattern,
                         testing::Values(LaunchPattern::LowDiscrepancy, LaunchPattern::Stratified,
                                         LaunchPattern::Random));

TEST_P(LaunchOfEachPattern, EveryPointOfTheTileIsEquallyLikely) {
    // One given ray of many batches: its place must be uniform over the tile, or the estimate would
    // be biased. Low discrepancy shifts by a random vector; strata by themselves are not uniform,
    // so there all rays of a batch are taken. Chi-square over 12 x 8 cells.
    const Heightfield s = level_tile(12, 8);
    std::vector<double> counts(96);
    double samples = 0;
    for (std::uint32_t batch = 0; batch < 6000; ++batch) {
        const LaunchBatch b(s, 1, {1, 0, 0, false}, {GetParam(), 5, 17, 2, batch});
        for (std::uint64_t k = 0; k < 5; ++k) {
            if (GetParam() == LaunchPattern::LowDiscrepancy && k != 3) continue;
            const Ray r = b.launch(k).ray;
            ASSERT_TRUE(r.i >= 0 && r.i < 12 && r.j >= 0 && r.j < 8);
            ASSERT_TRUE(r.u >= 0 && r.u < 1 && r.v >= 0 && r.v < 1);
            ++counts[static_cast<std::size_t>(r.j * 12 + r.i)];
            ++samples;
        }
    }
    double chi2 = 0;
    for (const double n : counts) chi2 += (n - samples / 96) * (n - samples / 96) / (samples / 96);
    EXPECT_LT(chi2, 95 + 4 * std::sqrt(2 * 95.0));
}

TEST(Launch, StratifiedPutsOnePointIntoEveryStratum) {
    // 16 x 16 cells and 256 x 4 points: 4 points in every cell, each in a quarter of its own.
    const Heightfield s = level_tile(16, 16);
    const LaunchBatch b(s, 1, {1, 0, 0, false}, {LaunchPattern::Stratified, 1024, 1, 0, 0});
    std::set<std::pair<int, int>> strata;
    for (std::uint64_t k = 0; k < 1024; ++k) {
        const Ray r = b.launch(k).ray;
        strata.insert({static_cast<int>((r.i + r.u) * 2), static_cast<int>((r.j + r.v) * 2)});
    }
    EXPECT_EQ(strata.size(), 1024u);
}

TEST(Launch, LatticeIsMoreEvenThanChance) {
    // Points in squares of a 16 x 16 board, 4096 points: 16 each on average; independent points
    // would scatter with variance 16, a lattice only by what its squares' sides cut: under a
    // quarter of that. Any number of points, also a prime one.
    const Heightfield s = level_tile(16, 16);
    for (const std::uint64_t n : {4096ULL, 4099ULL, 10007ULL}) {
        const LaunchBatch b(s, 1, {1, 0, 0, false}, {LaunchPattern::LowDiscrepancy, n, 1, 0, 0});
        std::vector<double> counts(256);
        for (std::uint64_t k = 0; k < n; ++k) {
            const Ray r = b.launch(k).ray;
            ++counts[static_cast<std::size_t>(r.j * 16 + r.i)];
        }
        double variance = 0;
        const double mean = static_cast<double>(n) / 256;
        for (const double c : counts) variance += (c - mean) * (c - mean) / 256;
        EXPECT_LT(variance, 0.25 * mean) << n;
    }
}

TEST(Launch, RowsOfTheLatticeAreShiftedByTheGoldenRatio) {
    const Heightfield s = level_tile(12, 8);
    const LaunchBatch b(s, 1, {1, 0, 0, false}, {LaunchPattern::LowDiscrepancy, 600, 17, 2, 0});
    const double golden = (std::sqrt(5.0) - 1) / 2;
    ASSERT_EQ(b.rows(), 50u);
    for (std::uint64_t r = 1; r < b.rows(); ++r) {
        const double step = b.row(r).u - b.row(r - 1).u;
        EXPECT_NEAR(step - std::floor(step), golden, 1e-12) << r;
    }
}

TEST(Launch, LightComesFromItsAzimuth) {
    const Heightfield s = level_tile(4, 4);
    const LaunchBatch b(s, 7, {1, radians(60), radians(90), false},
                        {LaunchPattern::Random, 4, 1, 0, 0});
    const Launch l = b.launch(0);
    EXPECT_EQ(l.ray.z, 7);
    EXPECT_EQ(l.ray.facet, -1);
    EXPECT_NEAR(l.ray.direction.y, -std::sin(radians(60)), 1e-15);  // from +y, so it travels to -y
    EXPECT_NEAR(l.ray.direction.z, -0.5, 1e-15);
}

TEST(Launch, IsotropicLightComesFromAllAround) {
    const Heightfield s = level_tile(4, 4);
    const LaunchBatch b(s, 1, {1, 1, 0, true}, {LaunchPattern::LowDiscrepancy, 20000, 1, 0, 0});
    std::vector<double> counts(8);
    for (std::uint64_t k = 0; k < 20000; ++k) {
        const Launch l = b.launch(k);
        EXPECT_NEAR(azimuth(-l.ray.direction), l.phi_i, 1e-12);
        ++counts[static_cast<std::size_t>(l.phi_i / (kPi / 4))];
    }
    double chi2 = 0;
    for (const double n : counts) chi2 += (n - 2500) * (n - 2500) / 2500;
    EXPECT_LT(chi2, 7 + 5 * std::sqrt(14.0));
}

}  // namespace
}  // namespace asperity
