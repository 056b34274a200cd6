// SPDX-License-Identifier: Apache-2.0
// Surfaces whose figures follow on paper.
#include <asperity/surface/areal_parameters.h>

#include <asperity/surface/autocorrelation.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/slope_fit.h>
#include <asperity/surface/spectral_density.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <tuple>

namespace asperity {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Heightfield surface_of(int nx, int ny, const std::function<double(int, int)>& height,
                       Boundary boundary = Boundary::Periodic) {
    Heightfield s;
    s.nx = nx, s.ny = ny;
    s.dx = 0.5, s.dy = 0.25;
    s.boundary = boundary;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) s.heights.push_back(static_cast<float>(height(i, j)));
    return s;
}

ArealParameters parameters(const Heightfield& s) {
    asperity::Run run(1);
    return areal_parameters(s, run);
}

// A sinusoid of amplitude 1 and 64 samples a period of 32.
TEST(ArealParameters, OfASinusoid) {
    const Heightfield s =
        surface_of(256, 64, [](int i, int) { return 7 + std::cos(kTurn * i / 64.0); });
    const ArealParameters p = parameters(s);
    const double turn = kTurn / 64;
    // The mean over 64 samples that hold the crest and the zeros: (2 / 64) cot(pi / 64)
    EXPECT_NEAR(p.sa, 2.0 / 64 / std::tan(kTurn / 128), 1e-6);
    EXPECT_NEAR(p.sq, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(p.sp, 1, 1e-6);
    EXPECT_NEAR(p.sv, 1, 1e-6);
    EXPECT_NEAR(p.sz, 2, 1e-6);
    EXPECT_NEAR(p.ssk, 0, 1e-6);
    EXPECT_NEAR(p.sku, 1.5, 1e-5);
    EXPECT_NEAR(p.sdq, std::sqrt(0.5) * 2 * std::sin(turn / 2) / 0.5, 1e-6);
    // cos(k r) = 0.2 along x; along y it never falls
    ASSERT_TRUE(p.sal.has_value());
    EXPECT_NEAR(*p.sal, std::acos(0.2) / turn * 0.5, 2e-3);
    EXPECT_FALSE(p.str.has_value());
    EXPECT_NEAR(p.std_deg.value(), 90, 1e-6);  // the ridges run along y
}

// cos + cos: the contour 0.2 of (cos u + cos v) / 2 is nearest on the diagonal, u = v = acos 0.2,
// and farthest on the axes, cos u = -0.6.
TEST(ArealParameters, AspectOfCrossedWaves) {
    for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
        Heightfield s = surface_of(
            640, 640,
            [](int i, int j) { return std::cos(kTurn * i / 64.0) + std::cos(kTurn * j / 64.0); },
            boundary);
        s.dy = s.dx;
        const ArealParameters p = parameters(s);
        const double scale = 64 / kTurn * 0.5;
        const double tolerance = boundary == Boundary::Periodic ? 1e-3 : 2e-2;
        EXPECT_NEAR(p.sal.value() / (std::numbers::sqrt2 * std::acos(0.2) * scale), 1, tolerance);
        EXPECT_NEAR(p.str.value() / (std::numbers::sqrt2 * std::acos(0.2) / std::acos(-0.6)), 1,
                    tolerance);
    }
}

// Waves across 30 degrees: u goes up to the right with rows that count down.
TEST(ArealParameters, DirectionIsCounterClockwiseFromX) {
    for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
        Heightfield s = surface_of(
            256, 256, [](int i, int j) { return std::cos(kTurn * (21 * i - 12 * j) / 256.0); },
            boundary);
        s.dy = s.dx;
        // Wave vector up to the right at atan(12 / 21) = 29.7 degrees, ridges across it
        EXPECT_NEAR(parameters(s).std_deg.value(), 29.745 - 90, 0.6);
    }
}

TEST(ArealParameters, CoreOfARampAndOfAPlateauWithPeaks) {
    // All heights alike often: the material ratio curve is one line from 1 to 0
    const ArealParameters ramp =
        parameters(surface_of(100, 100, [](int i, int j) { return (i + 100 * j + 0.5) / 1e4; }));
    EXPECT_NEAR(ramp.sk, 1, 1e-5);
    EXPECT_NEAR(ramp.spk, 0, 1e-3);
    EXPECT_NEAR(ramp.svk, 0, 1e-3);
    EXPECT_NEAR(ramp.smr1, 0, 0.02);
    EXPECT_NEAR(ramp.smr2, 100, 0.02);
    // 10 % peaks that rise evenly to 1, 20 % pits that fall evenly to -3, a plateau between
    const ArealParameters p = parameters(surface_of(100, 100, [](int i, int j) {
        const double share = (i + 100 * j + 0.5) / 1e4;
        return share < 0.1 ? 1 - share / 0.1 : share > 0.8 ? -3 * (share - 0.8) / 0.2 : 0.0;
    }));
    EXPECT_NEAR(p.sk, 0, 1e-6);
    EXPECT_NEAR(p.spk, 1, 1e-3);
    EXPECT_NEAR(p.svk, 3, 1e-3);
    EXPECT_NEAR(p.smr1, 10, 0.02);
    EXPECT_NEAR(p.smr2, 80, 0.02);
}

TEST(ArealParameters, OfAFlatSurface) {
    const ArealParameters p = parameters(surface_of(8, 8, [](int, int) { return 3.0; }));
    EXPECT_EQ(p.sz, 0);
    EXPECT_EQ(p.sk, 0);
    EXPECT_FALSE(p.sal || p.str || p.std_deg);
}

// Parseval: the integral over the plane of frequencies is Sq^2, whether the surface repeats or is
// seen through a window; one wave stands at its frequency.
TEST(SpectralDensity, IntegratesToTheVariance) {
    SurfaceSettings settings;
    settings.kind = "gaussian";
    settings.cell_x = 0.5;
    settings.correlation_x = settings.correlation_y = 6;
    asperity::Run run(1);
    for (const Boundary boundary : {Boundary::Periodic, Boundary::Finite}) {
        settings.boundary = boundary;
        const Heightfield s = make_surface(settings, run);
        const SpectralDensity d = spectral_density(s, run);
        const double step = 1 / (512 * 0.5);  // of the rings
        double sum = 0;
        for (std::size_t k = 0; k < d.frequency.size(); ++k)
            sum += d.radial[k] * kTurn * d.frequency[k] * step;
        const double sq = parameters(s).sq;
        EXPECT_NEAR(sum / (sq * sq), 1, boundary == Boundary::Periodic ? 0.02 : 0.06);
    }
    Heightfield wave =
        surface_of(256, 256, [](int i, int) { return 3 * std::cos(kTurn * 9 * i / 256.0); });
    wave.dy = wave.dx;
    const SpectralDensity d = spectral_density(wave, run);
    const auto strongest = std::max_element(d.radial.begin(), d.radial.end()) - d.radial.begin();
    EXPECT_NEAR(d.frequency[static_cast<std::size_t>(strongest)], 9.0 / 128, 1e-12);
}

TEST(Autocorrelation, OfAPatchIsAMeanOverTheOverlap) {
    const Heightfield s = surface_of(
        31, 9, [](int i, int j) { return (i * 7 + j * 5) % 11 + 0.1 * (i * j % 3); },
        Boundary::Finite);
    asperity::Run run(1);
    const HeightAutocorrelation acf(s, run);
    double mean = 0, square = 0;
    for (const float h : s.heights) mean += static_cast<double>(h) / (31 * 9);
    for (const float h : s.heights)
        square += (static_cast<double>(h) - mean) * (static_cast<double>(h) - mean) / (31 * 9);
    for (const auto& [a, b] : {std::pair{0, 0}, {3, 1}, {-4, 2}, {15, -4}}) {
        double sum = 0, count = 0;
        for (int j = 0; j < 9; ++j)
            for (int i = 0; i < 31; ++i) {
                if (i + a < 0 || i + a >= 31 || j + b < 0 || j + b >= 9) continue;
                const auto at = [&](int x, int y) {
                    return static_cast<double>(s.heights[static_cast<std::size_t>(y * 31 + x)]) -
                           mean;
                };
                sum += at(i, j) * at(i + a, j + b);
                count += 1;
            }
        EXPECT_NEAR(acf.at(a, b), sum / count / square, 1e-5) << a << ' ' << b;
    }
}

// A Gaussian surface and a GGX one bring their own alphas back, and each law fits its own best.
TEST(SlopeFit, FindsTheLawAndItsAlphas) {
    for (const auto& [kind, right, wrong] :
         {std::tuple{"gaussian", SlopeFamily::Beckmann, SlopeFamily::Ggx},
          std::tuple{"ggx", SlopeFamily::Ggx, SlopeFamily::Beckmann}}) {
        SurfaceSettings settings;
        settings.kind = kind;
        settings.alpha_x = 0.4, settings.alpha_y = 0.2;
        settings.correlation_x = settings.correlation_y = 5;
        settings.max_slope = 1000;
        asperity::Run run(1);
        const Heightfield s = make_surface(settings, run);
        const SlopeFit fit = fit_slopes(s, right, 1).value();
        EXPECT_NEAR(fit.alpha_x, 0.4, 0.02) << kind;
        EXPECT_NEAR(fit.alpha_y, 0.2, 0.01) << kind;
        EXPECT_LT(fit.misfit, 0.02) << kind;
        EXPECT_GT(fit_slopes(s, wrong, 1)->misfit, 0.05) << kind;
    }
    EXPECT_FALSE(fit_slopes(surface_of(8, 8, [](int i, int) { return i; }), SlopeFamily::Ggx, 1));
}

}  // namespace
}  // namespace asperity
