// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/tracing/engines/wide/sweeps_around.h>
#include <asperity/tracing/test_tracers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity {
namespace {

constexpr Incidence kAround{1, 0.6, 0, true};

using test::level_tile;

BatchRequest batch(std::uint64_t rays, std::uint32_t index) {
    return {LaunchPattern::LowDiscrepancy, rays, 17, 2, index};
}

TEST(SweepsAround, EveryAzimuthIsEquallyLikely) {
    // One given sweep of many batches: chi-square over 32 sectors
    const Heightfield s = level_tile(64, 48);
    for (const std::uint64_t rays : {500u, 30000u}) {
        std::vector<double> counts(32);
        constexpr std::uint32_t kBatches = 6400;
        for (std::uint32_t k = 0; k < kBatches; ++k) {
            const SweepsAround b(s, kAround, batch(rays, k));
            const Incidence light = b.light(k % b.sweeps());
            EXPECT_FALSE(light.isotropic);
            EXPECT_EQ(light.theta, kAround.theta);
            ++counts[static_cast<std::size_t>(light.phi / (2 * kPi) * 32)];
        }
        double chi2 = 0;
        for (const double n : counts) chi2 += (n - 200) * (n - 200) / 200;
        EXPECT_LT(chi2, 31 + 4 * std::sqrt(2 * 31.0)) << rays;
    }
}

TEST(SweepsAround, AzimuthsOfABatchAreEvenlySpread) {
    const Heightfield s = level_tile(64, 48);
    const SweepsAround b(s, kAround, batch(30000, 3));
    ASSERT_GT(b.sweeps(), 8u);
    for (std::uint64_t k = 1; k < b.sweeps(); ++k)
        EXPECT_NEAR(b.light(k).phi - b.light(k - 1).phi, 2 * kPi / static_cast<double>(b.sweeps()),
                    1e-12);
}

TEST(SweepsAround, HoldAllRaysAndNoPointTwice) {
    const Heightfield s = level_tile(64, 48);
    for (const std::uint64_t rays : {2u, 3000u, 30001u}) {
        const SweepsAround b(s, kAround, batch(rays, 5));
        std::uint64_t sum = 0;
        std::vector<double> offsets;
        for (std::uint64_t k = 0; k < b.sweeps(); ++k) {
            const SweepBatch sweep = b.sweep(k);
            for (std::uint64_t n = 0; n < sweep.stripes(); ++n) {
                const LaunchStripe stripe = sweep.stripe(n);
                for (int line = 0; line < stripe.lines; ++line)
                    sum += static_cast<std::uint64_t>(stripe.rays[line]);
                if (sweep.begins_pass(n)) offsets.push_back(sweep.offset(n));
            }
        }
        EXPECT_EQ(sum, rays);
        // Each sweep is shifted by itself
        std::sort(offsets.begin(), offsets.end());
        EXPECT_EQ(std::adjacent_find(offsets.begin(), offsets.end()), offsets.end());
    }
}

TEST(SweepsAround, AreForTheLatticeOfIsotropicLightAtAnAngle) {
    const Heightfield s = level_tile(64, 48);
    const auto possible = [&](const Incidence& light, LaunchPattern pattern) {
        return SweepsAround::possible(s, light, pattern);
    };
    EXPECT_TRUE(possible(kAround, LaunchPattern::LowDiscrepancy));
    EXPECT_FALSE(possible(kAround, LaunchPattern::Stratified));
    EXPECT_FALSE(possible(kAround, LaunchPattern::Random));
    EXPECT_FALSE(possible({1, 0.6, 0, false}, LaunchPattern::LowDiscrepancy));
    EXPECT_FALSE(possible({1, 0, 0, true}, LaunchPattern::LowDiscrepancy));
}

}  // namespace
}  // namespace asperity
