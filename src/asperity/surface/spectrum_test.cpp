// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/spectrum.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity {
namespace {

using Complex = std::complex<double>;

std::size_t at(int j, int i, int nx) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
}

std::vector<float> noise(int nx, int ny) {
    const CounterRandom random(5, 1);
    std::vector<float> values;
    for (int k = 0; k < nx * ny; ++k)
        values.push_back(static_cast<float>(random.normal2(static_cast<std::uint64_t>(k))[0]));
    return values;
}

/// The transform by its definition: sum of values * exp(-2 pi i (kx x / nx + ky y / ny)).
std::vector<Complex> slow_transform(const std::vector<float>& values, int nx, int ny) {
    std::vector<Complex> spectrum;
    for (int ky = 0; ky < ny; ++ky)
        for (int kx = 0; kx < nx; ++kx) {
            Complex sum = 0;
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) {
                    const double turns = static_cast<double>(kx * i % nx) / nx +
                                         static_cast<double>(ky * j % ny) / ny;
                    sum += static_cast<double>(values[at(j, i, nx)]) *
                           std::polar(1.0, -2 * kPi * turns);
                }
            spectrum.push_back(sum);
        }
    return spectrum;
}

struct Size {
    int nx, ny;
};

class SpectrumSizes : public ::testing::TestWithParam<Size> {};

INSTANTIATE_TEST_SUITE_P(EvenOddPrimeAndMultiplesOfFour, SpectrumSizes,
                         ::testing::Values(Size{2, 2}, Size{2, 3}, Size{3, 2}, Size{5, 4},
                                           Size{8, 6}, Size{12, 7}, Size{13, 16}, Size{6, 11},
                                           Size{20, 9}, Size{77, 4}));

TEST_P(SpectrumSizes, ForwardAgreesWithTheDefinition) {
    const auto [nx, ny] = GetParam();
    std::vector<float> values = noise(nx, ny);
    const auto expected = slow_transform(values, nx, ny);
    asperity::Run run(2);
    const auto compare = [&, nx = nx, ny = ny](int kx, std::span<std::complex<float>> column) {
        ASSERT_EQ(column.size(), static_cast<std::size_t>(ny));
        for (int ky = 0; ky < ny; ++ky)
            EXPECT_LT(
                std::abs(Complex(column[static_cast<std::size_t>(ky)]) - expected[at(ky, kx, nx)]),
                1e-5 * nx * ny)
                << kx << ' ' << ky;
    };
    filter_spectrum({nx, ny, values}, compare, run);
}

TEST_P(SpectrumSizes, SynthesisOfTheTransformGivesTheValuesBack) {
    const auto [nx, ny] = GetParam();
    const std::vector<float> values = noise(nx, ny);
    const auto spectrum = slow_transform(values, nx, ny);
    std::vector<float> result(values.size());
    asperity::Run run(2);
    const auto make = [&, nx = nx, ny = ny](int kx, std::span<std::complex<float>> column) {
        for (int ky = 0; ky < ny; ++ky)
            column[static_cast<std::size_t>(ky)] =
                std::complex<float>(spectrum[at(ky, kx, nx)] / static_cast<double>(nx * ny));
    };
    synthesize({nx, ny, result}, make, run);
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(result[k], values[k], 2e-6);
}

class LargerSizes : public ::testing::TestWithParam<Size> {};

INSTANTIATE_TEST_SUITE_P(Sizes, LargerSizes,
                         ::testing::Values(Size{120, 121}, Size{121, 120}, Size{250, 64},
                                           Size{97, 250}, Size{512, 300}));

TEST_P(LargerSizes, FilterByOneChangesNothing) {
    const auto [nx, ny] = GetParam();
    const std::vector<float> values = noise(nx, ny);
    std::vector<float> result = values;
    asperity::Run run(2);
    const float scale = 1.0F / static_cast<float>(nx * ny);
    filter_spectrum(
        {nx, ny, result},
        [&](int, std::span<std::complex<float>> column) {
            for (auto& c : column) c *= scale;
        },
        run);
    for (std::size_t k = 0; k < values.size(); ++k) ASSERT_NEAR(result[k], values[k], 5e-6);
}

TEST(Spectrum, OneCoefficientIsOneWave) {
    // Half spectrum coefficient c at (3, 5) stands for itself and its conjugate at (-3, -5): the
    // sum is 2 Re(c exp(i phase)).
    const int nx = 20, ny = 30;
    std::vector<float> values(static_cast<std::size_t>(nx * ny));
    asperity::Run run(2);
    const auto make = [](int kx, std::span<std::complex<float>> column) {
        std::fill(column.begin(), column.end(), std::complex<float>());
        if (kx == 3) column[5] = {0.75F, -0.5F};
    };
    synthesize({nx, ny, values}, make, run);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const double phase = 2 * kPi * (3.0 * i / nx + 5.0 * j / ny);
            EXPECT_NEAR(values[at(j, i, nx)], 2 * (0.75 * std::cos(phase) + 0.5 * std::sin(phase)),
                        2e-6);
        }
}

TEST(Spectrum, SameBitsForAnyNumberOfThreads) {
    const int nx = 121, ny = 250;
    const auto smooth = [](int kx, std::span<std::complex<float>> column) {
        for (std::size_t ky = 0; ky < column.size(); ++ky)
            column[ky] *= 1.0F / (1.0F + static_cast<float>(kx) + static_cast<float>(ky));
    };
    std::vector<float> reference = noise(nx, ny);
    asperity::Run one(1);
    filter_spectrum({nx, ny, reference}, smooth, one);
    for (const int threads : {2, 3, 7}) {
        std::vector<float> values = noise(nx, ny);
        asperity::Run run(threads);
        filter_spectrum({nx, ny, values}, smooth, run);
        EXPECT_EQ(values, reference) << threads;
    }
}

TEST(Spectrum, StopsWhenAsked) {
    std::vector<float> values = noise(64, 64);
    asperity::Run run(2);
    run.request_stop();
    try {
        filter_spectrum(
            {64, 64, values}, [](int, std::span<std::complex<float>>) {}, run);
        ADD_FAILURE() << "did not stop";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Stopped);
    }
}

}  // namespace
}  // namespace asperity
