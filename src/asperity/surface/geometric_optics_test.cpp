// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/geometric_optics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace asperity {
namespace {

Heightfield surface_of(int n, double step, const std::function<double(double, double)>& height) {
    Heightfield s;
    s.nx = s.ny = n;
    s.dx = s.dy = step;
    s.unit = "m";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            s.heights.push_back(static_cast<float>(height(i * step, j * step)));
    return s;
}

GeometricOptics at(const Heightfield& s, double wavelength) {
    return geometric_optics(s, wavelength, asperity::Run(1));
}

// A bowl of radius 20 um: sharp for all light above 4 um, for none below.
TEST(GeometricOptics, CurvatureIsThatOfASphere) {
    Heightfield s = surface_of(41, 1e-7, [](double x, double y) {
        const double r2 = (x - 2e-6) * (x - 2e-6) + (y - 2e-6) * (y - 2e-6);
        return 20e-6 - std::sqrt(400e-12 - r2);
    });
    s.boundary = Boundary::Finite;
    // Heights are floats: curvature is known to a few per cent
    EXPECT_EQ(at(s, 3.6e-6).sharp_share, 0);
    EXPECT_EQ(at(s, 4.4e-6).sharp_share, 1);
}

// z = a cos(k x): curvature a k^2 |cos| near the crests, about; half of the area is beyond 1/sqrt2.
TEST(GeometricOptics, SharpShareOfAGentleWave) {
    const double period = 64e-6, k = 2 * std::numbers::pi / period, amplitude = 1e-6;
    const Heightfield s =
        surface_of(256, 0.25e-6, [&](double x, double) { return amplitude * std::cos(k * x); });
    const double radius = std::numbers::sqrt2 / (amplitude * k * k);
    EXPECT_NEAR(at(s, radius / 5).sharp_share, 0.5, 0.02);
    const GeometricOptics g = at(s, 500e-9);
    EXPECT_NEAR(g.rms_height, std::numbers::sqrt2, 1e-5);
    EXPECT_LT(g.coherent_share, 1e-12);
    EXPECT_NEAR(g.spacing, 0.5, 1e-12);
    // |sin(k dx)| / |2 sin(k dx / 2)| = cos(k dx / 2)
    EXPECT_NEAR(g.slope_ratio, std::cos(0.5 * k * 0.25e-6), 1e-4);
    EXPECT_TRUE(g.holds);
    EXPECT_EQ(g.verdict, "geometric optics holds at 0.5 um");
}

TEST(GeometricOptics, ASmoothSurfaceIsAMirrorOfWaves) {
    const double a = 50e-9 * std::numbers::sqrt2;
    const Heightfield s = surface_of(
        64, 1e-6, [&](double x, double) { return a * std::cos(2 * std::numbers::pi * x / 32e-6); });
    const GeometricOptics g = at(s, 500e-9);
    EXPECT_NEAR(g.coherent_share, std::exp(-std::pow(0.4 * std::numbers::pi, 2)), 1e-5);
    EXPECT_FALSE(g.holds);
    EXPECT_NE(g.verdict.find("about 20.6 % of the reflected light stays in the mirror direction"),
              std::string::npos)
        << g.verdict;
}

// Independent heights: over two steps the differences are as large, so the slopes half.
TEST(GeometricOptics, IndependentHeightsHaveNoSlopes) {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal(0, 3e-6);
    const Heightfield s = surface_of(128, 100e-6, [&](double, double) { return normal(engine); });
    const GeometricOptics g = at(s, 500e-9);
    EXPECT_NEAR(g.slope_ratio, 0.5, 0.01);
    EXPECT_FALSE(g.holds);
    EXPECT_NE(g.verdict.find("the slopes are not resolved"), std::string::npos) << g.verdict;
}

}  // namespace
}  // namespace asperity
