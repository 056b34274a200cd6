// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/chi_square.h>
#include <asperity/render/sampler.h>

#include <gtest/gtest.h>

#include <vector>

namespace asperity {
namespace {

/// Pair `dimension` of a sample, 0 first.
std::array<double, 2> pair_of(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample,
                              int dimension) {
    PixelSampler sampler(seed, pixel, sample);
    for (int d = 0; d < dimension; ++d) sampler.next2();
    return sampler.next2();
}

std::size_t cell_of(std::array<double, 2> p, int columns, int rows) {
    EXPECT_TRUE(p[0] >= 0 && p[0] < 1 && p[1] >= 0 && p[1] < 1) << p[0] << ' ' << p[1];
    return static_cast<std::size_t>(p[1] * rows) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(p[0] * columns);
}

TEST(PixelSampler, SamplesOfAPixelAreANet) {
    // A (0, 2)-sequence: of the first 2^m points every box of 2^-a by 2^(a - m) holds exactly one
    constexpr int kBits = 8;
    for (const int dimension : {0, 1, 7})
        for (int a = 0; a <= kBits; ++a) {
            const int columns = 1 << a, rows = 1 << (kBits - a);
            std::vector<int> points(1u << kBits, 0);
            for (std::uint32_t sample = 0; sample < points.size(); ++sample)
                ++points[cell_of(pair_of(1, 4711, sample, dimension), columns, rows)];
            EXPECT_EQ(points, std::vector<int>(points.size(), 1)) << dimension << ' ' << a;
        }
}

TEST(PixelSampler, EachSampleIsUniformOverPixels) {
    // Unbiased after any number of samples: each one for itself is uniform
    constexpr int kSide = 16, kPixels = 1 << 18;
    for (const std::uint32_t sample : {0u, 5u, 1000003u}) {
        std::vector<double> counts(kSide * kSide, 0.0);
        for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel)
            ++counts[cell_of(pair_of(2, pixel, sample, 1), kSide, kSide)];
        const std::vector<double> expected(counts.size(), 1.0 * kPixels / (kSide * kSide));
        EXPECT_GT(test::chi_square_p_value(counts, expected), 1e-3) << sample;
    }
}

/// p-value of two numbers being independent of each other, both uniform.
template <typename Two>
double independence(Two two) {
    constexpr int kSide = 16, kSamples = 1 << 16;
    std::vector<double> counts(kSide * kSide, 0.0);
    for (std::uint32_t sample = 0; sample < kSamples; ++sample)
        ++counts[cell_of(two(sample), kSide, kSide)];
    return test::chi_square_p_value(
        counts, std::vector<double>(counts.size(), 1.0 * kSamples / (kSide * kSide)));
}

TEST(PixelSampler, PairsPixelsAndSeedsAreIndependent) {
    const auto first_of = [](std::uint64_t seed, std::uint32_t pixel, int dimension) {
        return [=](std::uint32_t sample) { return pair_of(seed, pixel, sample, dimension)[0]; };
    };
    const auto against = [](auto x, auto y) {
        return independence([=](std::uint32_t s) { return std::array{x(s), y(s)}; });
    };
    const auto here = first_of(3, 100, 0);
    EXPECT_GT(against(here, first_of(3, 100, 1)), 1e-3);
    EXPECT_GT(against(here, first_of(3, 100, 2)), 1e-3);
    EXPECT_GT(against(here, first_of(3, 101, 0)), 1e-3);
    EXPECT_GT(against(here, first_of(4, 100, 0)), 1e-3);
    // Able to fail: a number is no independent of itself
    EXPECT_LT(against(here, here), 1e-6);
}

TEST(PixelSampler, BelongsToItsArguments) {
    EXPECT_EQ(pair_of(1, 2, 3, 4), pair_of(1, 2, 3, 4));
    EXPECT_NE(pair_of(1, 2, 3, 4), pair_of(1, 2, 4, 4));
    EXPECT_NE(pair_of(1, 2, 3, 4), pair_of(1, 2, 3, 5));
}

}  // namespace
}  // namespace asperity
