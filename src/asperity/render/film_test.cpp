// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/random.h>
#include <asperity/render/film.h>

#include <gtest/gtest.h>

#include <limits>

namespace asperity {
namespace {

Rgb grey(double value) {
    return {value, value, value};
}

// 1, 2, 6: mean 3, squared differences 4 + 1 + 9 = 14, variance 14 / 2, error sqrt(7 / 3).
TEST(Pixel, MeanAndErrorByHand) {
    Pixel pixel;
    EXPECT_EQ(pixel.standard_error(), 0);
    for (const double value : {1.0, 2.0, 6.0}) pixel.add(grey(value));
    EXPECT_NEAR(pixel.mean.g, 3, 1e-15);
    EXPECT_NEAR(pixel.variance(), 7, 1e-13);
    EXPECT_NEAR(pixel.standard_error(), std::sqrt(7 / 3.0), 1e-14);
}

TEST(Film, ImageIsTheMeans) {
    Film film(3, 2);
    film.at(2, 1).add({1, 2, 3});
    film.at(2, 1).add({3, 4, 5});
    const Image image = film.image();
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    ASSERT_EQ(image.rgb.size(), 18u);
    EXPECT_EQ(image.at(2, 1), (Rgb{2, 3, 4}));
    EXPECT_EQ(image.at(1, 1), Rgb{});
}

// Samples 1 and 3: mean 2, variance 2, squared error 1; samples 3 and 7: mean 5, squared error 4.
// The third pixel never changes and does not count: sqrt((1 + 4) / (4 + 25)).
TEST(Noise, ByHand) {
    Film film(3, 1);
    for (const double value : {1.0, 3.0}) film.at(0, 0).add(grey(value));
    for (const double value : {3.0, 7.0}) film.at(1, 0).add(grey(value));
    EXPECT_EQ(noise(film), std::numeric_limits<double>::infinity());
    film.at(2, 0).add(grey(100));
    EXPECT_EQ(noise(film), std::numeric_limits<double>::infinity());
    film.at(2, 0).add(grey(100));
    EXPECT_NEAR(noise(film), std::sqrt(5.0 / 29.0), 1e-14);
}

TEST(Noise, IsNoneWhereNothingVaries) {
    Film film(2, 2);
    EXPECT_EQ(noise(film), std::numeric_limits<double>::infinity());
    for (int k = 0; k < 3; ++k)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) film.at(x, y).add(grey(0.5));
    EXPECT_EQ(noise(film), 0);
}

TEST(Noise, SameBitsForAnyNumberOfThreads) {
    const auto made_with = [](int threads) {
        Film film(37, 29);
        parallel_for(37 * 29, threads, [&](std::size_t k) {
            for (std::uint32_t n = 0; n < 5; ++n)
                film.at(static_cast<int>(k) % 37, static_cast<int>(k) / 37)
                    .add(grey(CounterRandom(1, n).uniform2(k)[0]));
        });
        return noise(film);
    };
    const double alone = made_with(1);
    EXPECT_GT(alone, 0.2);  // of numbers uniform in [0, 1): 1 / sqrt(12 * 5) over 1/2
    EXPECT_LT(alone, 0.3);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(made_with(threads), alone);
}

// Luminances 1, 3 against 2, 1.
TEST(Compare, ByHand) {
    const Image a{2, 1, {1, 1, 1, 3, 3, 3}}, b{2, 1, {2, 2, 2, 1, 1, 1}};
    const ImageDifference d = compare(a, b);
    EXPECT_NEAR(d.mean_a, 2, 1e-15);
    EXPECT_NEAR(d.mean_b, 1.5, 1e-15);
    EXPECT_NEAR(d.mean_absolute, 1.5, 1e-15);
    EXPECT_NEAR(d.rms, std::sqrt(2.5), 1e-15);
    EXPECT_NEAR(d.relative, 0.75, 1e-15);
    const ImageDifference none = compare(a, a);
    EXPECT_EQ(none.mean_absolute, 0);
    EXPECT_EQ(none.rms, 0);
    const Image black{2, 1, std::vector<float>(6, 0.0F)};
    EXPECT_EQ(compare(black, a).relative, 0);
    EXPECT_THROW(compare(a, Image{1, 2, std::vector<float>(6, 0.0F)}), Error);
}

}  // namespace
}  // namespace asperity
