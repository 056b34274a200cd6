// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace asperity {
namespace {

TEST(CounterRandom, AnswersThePublishedVector) {
    // Philox4x32-10, known answer of Salmon et al.: counter and key all zero.
    const auto b = CounterRandom(0, 0).bits(0, 0);
    EXPECT_EQ(b[0], 0x6627e8d5u);
    EXPECT_EQ(b[1], 0xe169c58du);
    EXPECT_EQ(b[2], 0xbc57ac4cu);
    EXPECT_EQ(b[3], 0x9b00dbd8u);
}

TEST(CounterRandom, UniformFillsItsCells) {
    // Chi-square over 64 x 64 cells, 4095 degrees of freedom; mean 4095, sd sqrt(2 4095) = 90.5.
    constexpr int kSide = 64, kSamples = 1 << 20;
    std::vector<int> counts(kSide * kSide);
    const CounterRandom random(7, 3);
    for (int k = 0; k < kSamples; ++k) {
        const auto u = random.uniform2(static_cast<std::uint64_t>(k));
        ASSERT_GE(u[0], 0);
        ASSERT_LT(u[0], 1);
        ++counts[static_cast<std::size_t>(static_cast<int>(u[0] * kSide) * kSide +
                                          static_cast<int>(u[1] * kSide))];
    }
    const double expected = static_cast<double>(kSamples) / (kSide * kSide);
    double chi2 = 0;
    for (const int n : counts) chi2 += (n - expected) * (n - expected) / expected;
    EXPECT_NEAR(chi2, 4095, 4 * 90.5);
}

TEST(CounterRandom, NormalHasItsMoments) {
    constexpr int kSamples = 500000;
    const CounterRandom random(1, 2);
    double sum = 0, sum2 = 0, sum4 = 0;
    for (int k = 0; k < kSamples; ++k)
        for (const double x : random.normal2(static_cast<std::uint64_t>(k))) {
            sum += x;
            sum2 += x * x;
            sum4 += x * x * x * x;
        }
    const double n = 2.0 * kSamples;
    // Standard errors: 1 / sqrt n, sqrt(2 / n), sqrt(96 / n).
    EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
    EXPECT_NEAR(sum2 / n, 1, 4 * std::sqrt(2 / n));
    EXPECT_NEAR(sum4 / n, 3, 4 * std::sqrt(96 / n));
}

TEST(CounterRandom, NeighbouringSeedsAndStreamsAreUnrelated) {
    // The seeding trap of physics.md A2: streams of seeds n and n + 1 must not be shifted copies.
    constexpr int kSamples = 100000;
    const auto correlation = [](const CounterRandom& a, const CounterRandom& b, int shift) {
        double sum = 0;
        for (int k = 0; k < kSamples; ++k)
            sum += (a.uniform2(static_cast<std::uint64_t>(k))[0] - 0.5) *
                   (b.uniform2(static_cast<std::uint64_t>(k + shift))[0] - 0.5);
        return 12 * sum / kSamples;
    };
    for (int shift = 0; shift <= 2; ++shift) {
        EXPECT_NEAR(correlation({5, 0}, {6, 0}, shift), 0, 4 / std::sqrt(kSamples));
        EXPECT_NEAR(correlation({5, 0}, {5, 1}, shift), 0, 4 / std::sqrt(kSamples));
    }
}

}  // namespace
}  // namespace asperity
