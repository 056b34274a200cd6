// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/gonio/launch.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace asperity {
namespace {

Heightfield tile(int nx, int ny) {
    Heightfield s;
    s.nx = nx;
    s.ny = ny;
    s.heights.assign(static_cast<std::size_t>(nx * ny), 0.0f);
    return s;
}

class LaunchOfEachPattern : public testing::TestWithParam<LaunchPattern> {};
INSTANTIATE_TEST_SUITE_P(Patterns, LaunchOfEachPattern,
                         testing::Values(LaunchPattern::LowDiscrepancy, LaunchPattern::Stratified,
                                         LaunchPattern::Random));

TEST_P(LaunchOfEachPattern, EveryPointOfTheTileIsEquallyLikely) {
    // One given ray of many batches: its place must be uniform over the tile, or the estimate would
    // be biased. Low discrepancy shifts by a random vector; strata by themselves are not uniform,
    // so there all rays of a batch are taken. Chi-square over 12 x 8 cells.
    const Heightfield s = tile(12, 8);
    std::vector<double> counts(96);
    double samples = 0;
    for (std::uint32_t batch = 0; batch < 6000; ++batch) {
        const LaunchBatch b(s, 1, {1, 0, 0, false}, GetParam(), 5, 17, 2, batch);
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

/// Batches with rays for all lines, and with fewer than that.
TEST(Launch, LinesFindEveryPointOfTheTileEquallyLikely) {
    // One ray of each of many batches, told by its line and how far along it lies; chi-square over
    // 12 x 8 parts of the tile, and over where in its cell it starts.
    const Heightfield s = tile(96, 64);
    for (const auto& [rays, stripes] : {std::pair{13, 1}, {700, 2}, {2000, 3}}) {
        std::vector<double> counts(96), offsets(8);
        constexpr std::uint32_t kBatches = 9600;
        for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
            const LaunchBatch b(s, 1, {1, 0.3, radians(70), false}, LaunchPattern::LowDiscrepancy,
                                static_cast<std::uint64_t>(rays), 17, 2, batch);
            ASSERT_EQ(b.order(), LaunchBatch::Order::Lines);
            ASSERT_EQ(b.stripes(), static_cast<std::uint64_t>(stripes));
            int ray = static_cast<int>(batch) % rays;
            for (std::uint64_t n = 0; n < b.stripes(); ++n) {
                const LaunchStripe stripe = b.stripe(n);
                for (std::size_t k = 0; k < static_cast<std::size_t>(stripe.lines); ++k) {
                    if (ray >= 0 && ray < stripe.rays[k]) {
                        const int line = (stripe.first + static_cast<int>(k)) % 96;
                        const double along = (stripe.phase[k] + ray) / stripe.rays[k];
                        ++counts[static_cast<std::size_t>(line / 8 * 8 +
                                                          static_cast<int>(8 * along))];
                        ++offsets[static_cast<std::size_t>(8 * b.offset(n))];
                    }
                    ray -= stripe.rays[k];
                }
            }
        }
        const auto chi_square = [&](const std::vector<double>& parts) {
            const double expected = kBatches / static_cast<double>(parts.size());
            double chi2 = 0;
            for (const double n : parts) chi2 += (n - expected) * (n - expected) / expected;
            return chi2;
        };
        EXPECT_LT(chi_square(counts), 95 + 4 * std::sqrt(2 * 95.0)) << rays;
        EXPECT_LT(chi_square(offsets), 7 + 5 * std::sqrt(14.0)) << rays;
    }
}

TEST(Launch, LinesHoldAllRaysAndNoneTwice) {
    const Heightfield s = tile(100, 40);
    for (const double phi : {0.0, 50.0, 90.0, 200.0})
        for (const std::uint64_t rays : {2, 97, 250, 4000, 10007}) {
            const LaunchBatch b(s, 1, {1, 1.2, radians(phi), false}, LaunchPattern::LowDiscrepancy,
                                rays, 1, 0, 3);
            std::set<std::pair<int, double>> lines;  // cell and place in it
            std::uint64_t sum = 0;
            std::size_t count = 0;
            const int across =
                std::abs(std::cos(radians(phi))) > std::abs(std::sin(radians(phi))) ? 40 : 100;
            for (std::uint64_t n = 0; n < b.stripes(); ++n) {
                const LaunchStripe stripe = b.stripe(n);
                for (int k = 0; k < stripe.lines; ++k) {
                    lines.insert({(stripe.first + k) % across, b.offset(n)});
                    sum += static_cast<std::uint64_t>(stripe.rays[k]);
                    ++count;
                    // As far as light sinks while it crosses the tile
                    const double cells = across == 40 ? 100 / std::abs(std::cos(radians(phi)))
                                                      : 40 / std::abs(std::sin(radians(phi)));
                    if (stripe.rays[k] > 0) {
                        EXPECT_NEAR(stripe.spacing[k] * stripe.rays[k], cells / std::tan(1.2),
                                    1e-9);
                    }
                }
            }
            EXPECT_EQ(sum, rays);
            EXPECT_EQ(lines.size(), count);
        }
}

TEST(Launch, StratifiedPutsOnePointIntoEveryStratum) {
    // 16 x 16 cells and 256 x 4 points: 4 points in every cell, each in a quarter of its own.
    const Heightfield s = tile(16, 16);
    const LaunchBatch b(s, 1, {1, 0, 0, false}, LaunchPattern::Stratified, 1024, 1, 0, 0);
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
    const Heightfield s = tile(16, 16);
    for (const std::uint64_t n : {4096ULL, 4099ULL, 10007ULL}) {
        const LaunchBatch b(s, 1, {1, 0, 0, false}, LaunchPattern::LowDiscrepancy, n, 1, 0, 0);
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

TEST(Launch, LightComesFromItsAzimuth) {
    const Heightfield s = tile(4, 4);
    const LaunchBatch b(s, 7, {1, radians(60), radians(90), false}, LaunchPattern::Random, 4, 1, 0,
                        0);
    const Launch l = b.launch(0);
    EXPECT_EQ(l.ray.z, 7);
    EXPECT_EQ(l.ray.facet, -1);
    EXPECT_NEAR(l.ray.direction.y, -std::sin(radians(60)), 1e-15);  // from +y, so it travels to -y
    EXPECT_NEAR(l.ray.direction.z, -0.5, 1e-15);
}

TEST(Launch, IsotropicLightComesFromAllAround) {
    const Heightfield s = tile(4, 4);
    const LaunchBatch b(s, 1, {1, 1, 0, true}, LaunchPattern::LowDiscrepancy, 20000, 1, 0, 0);
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

TEST(Launch, ThesisLayersGoFromNormalIncidenceDown) {
    const auto list = incidences(IlluminationSettings{});
    ASSERT_EQ(list.size(), 15u);
    EXPECT_EQ(list.front().number, 15);
    EXPECT_EQ(list.front().theta, 0);
    EXPECT_EQ(list.back().number, 1);
    EXPECT_NEAR(degrees(list.back().theta), 84, 1e-12);  // elevation 6 degrees
    EXPECT_NEAR(degrees(list[5].theta), 30, 1e-12);
}

TEST(Launch, ListsOfAnglesMakeEveryPair) {
    IlluminationSettings light;
    light.theta_deg = {10, 20};
    light.phi_deg = {0, 45, 90};
    const auto list = incidences(light);
    ASSERT_EQ(list.size(), 6u);
    EXPECT_EQ(list[4].number, 5);
    EXPECT_NEAR(degrees(list[4].theta), 20, 1e-12);
    EXPECT_NEAR(degrees(list[4].phi), 45, 1e-12);
}

}  // namespace
}  // namespace asperity
