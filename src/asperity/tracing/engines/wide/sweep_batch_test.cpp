// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/tracing/engines/wide/sweep_batch.h>
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace asperity {
namespace {

using test::level_tile;

/// Batches with rays for all lines, and with fewer than that.
TEST(Sweep, LinesFindEveryPointOfTheTileEquallyLikely) {
    // One ray of each of many batches, told by its line and how far along it lies; chi-square over
    // 12 x 8 parts of the tile, and over where in its cell it starts.
    const Heightfield s = level_tile(96, 64);
    for (const auto& [rays, stripes] : {std::pair{13, 1}, {700, 2}, {2000, 3}}) {
        std::vector<double> counts(96), offsets(8);
        constexpr std::uint32_t kBatches = 9600;
        for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
            const Incidence light{1, 0.3, radians(70), false};
            const SweepBatch b(
                s, light,
                {LaunchPattern::LowDiscrepancy, static_cast<std::uint64_t>(rays), 17, 2, batch});
            ASSERT_TRUE(SweepBatch::possible(s, light, LaunchPattern::LowDiscrepancy));
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

/// Along an axis or a diagonal every line comes through the same places of its cells again and
/// again: two passes, half a cell aside, where one would do.
TEST(Sweep, LightAlongTheGridPassesTwice) {
    const Heightfield s = level_tile(96, 64);
    const auto passes = [&](double phi) {
        const Incidence light{1, 0.3, radians(phi), false};
        const SweepBatch b(s, light, {LaunchPattern::LowDiscrepancy, 2000, 17, 2, 0});
        int count = 0;
        for (std::uint64_t n = 0; n < b.stripes(); ++n) count += b.begins_pass(n) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(passes(70), 1);
    for (const double phi : {0.0, 90.0, 45.0, 135.0, 180.0, 270.0}) EXPECT_EQ(passes(phi), 2);
}

TEST(Sweep, LinesHoldAllRaysAndNoneTwice) {
    const Heightfield s = level_tile(100, 40);
    for (const double phi : {0.0, 50.0, 90.0, 200.0})
        for (const std::uint64_t rays : {2u, 97u, 250u, 4000u, 10007u}) {
            const Incidence light{1, 1.2, radians(phi), false};
            const SweepBatch b(s, light, {LaunchPattern::LowDiscrepancy, rays, 1, 0, 3});
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

}  // namespace
}  // namespace asperity
