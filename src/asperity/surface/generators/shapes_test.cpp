// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

constexpr double kTolerance = 1e-5;  // heights are floats up to 16

SurfaceSettings shape(const std::string& kind, int size, int period, double tilt_deg = 30) {
    SurfaceSettings s = settings_of(kind, size);
    s.period = period;
    s.tilt_deg = tilt_deg;
    return s;
}

/// Calls check(i, j, slope) for every facet of the surface made with both diagonals.
template <class Check>
void for_facets(SurfaceSettings settings, const Check& check) {
    for (const Diagonal diagonal : {Diagonal::Anti, Diagonal::Main}) {
        settings.diagonal = diagonal;
        const Heightfield s = make(settings);
        EXPECT_EQ(s.diagonal, diagonal);
        for (int j = 0; j < s.cells_y(); ++j)
            visit_facets(s, j, [&](int i, Triangle, Slope slope) { check(i, j, slope); });
    }
}

TEST(Shapes, FlatHasNoHeight) {
    const Heightfield s = make(settings_of("flat", 7));
    EXPECT_EQ(s.heights, std::vector<float>(49, 0.0F));
    EXPECT_TRUE(s.isotropic);
}

// Valley at x = 0, ridge at P / 2: slope +tan t in the first half of every period, -tan t after.
TEST(Shapes, GrooveHasTwoFacetsAPeriod) {
    const double t = std::tan(radians(30));
    for (const bool along_y : {false, true}) {
        SurfaceSettings settings = shape("vgroove", 24, 8);
        settings.along_y = along_y;
        for_facets(settings, [&](int i, int j, Slope s) {
            const int phase = (along_y ? j : i) % 8;
            EXPECT_NEAR(along_y ? s.y : s.x, phase < 4 ? t : -t, kTolerance);
            EXPECT_EQ(along_y ? s.x : s.y, 0);
        });
    }
}

TEST(Shapes, GrooveAt45DegreesIsExact) {
    const Heightfield s = make(shape("vgroove", 8, 8, 45));
    const std::vector<float> row(s.heights.begin(), s.heights.begin() + 8);
    for (int i = 0; i < 8; ++i)
        EXPECT_NEAR(row[static_cast<std::size_t>(i)], std::min(i, 8 - i), 1e-6);
}

// P - 1 cells of slope tan t, then back to the start: -(P - 1) tan t.
TEST(Shapes, SawtoothFallsBackInOneCell) {
    const double t = std::tan(radians(30));
    for (const bool along_y : {false, true}) {
        SurfaceSettings settings = shape("sawtooth", 20, 5);
        settings.along_y = along_y;
        for_facets(settings, [&](int i, int j, Slope s) {
            const int phase = (along_y ? j : i) % 5;
            EXPECT_NEAR(along_y ? s.y : s.x, phase < 4 ? t : -4 * t, kTolerance);
            EXPECT_EQ(along_y ? s.x : s.y, 0);
        });
    }
}

TEST(Shapes, TiltedIsOneFacetAndItsReturn) {
    const double t = std::tan(radians(30));
    for_facets(shape("tilted", 20, 3), [&](int i, int, Slope s) {
        EXPECT_NEAR(s.x, i < 19 ? t : -19 * t, kTolerance);
        EXPECT_EQ(s.y, 0);
    });
    // The finite patch is one plane: it has no return
    SurfaceSettings patch = shape("tilted", 20, 3);
    patch.boundary = Boundary::Finite;
    patch.along_y = true;
    for_facets(patch, [&](int, int, Slope s) {
        EXPECT_EQ(s.x, 0);
        EXPECT_NEAR(s.y, t, kTolerance);
    });
}

// Slopes (+-s, +-s) with s = tan t / sqrt2: every facet is tilted by t, towards the four corners.
TEST(Shapes, PyramidsHaveFacetsOfOneTilt) {
    const double slope = std::tan(radians(40)) / std::sqrt(2.0);
    for_facets(shape("pyramids", 12, 6, 40), [&](int i, int j, Slope s) {
        EXPECT_NEAR(s.x, i % 6 < 3 ? slope : -slope, kTolerance);
        EXPECT_NEAR(s.y, j % 6 < 3 ? slope : -slope, kTolerance);
        EXPECT_NEAR(degrees(polar_angle(normal_of(s))), 40, 1e-4);
    });
}

TEST(Shapes, WavesAreSines) {
    SurfaceSettings settings = settings_of("sinusoid", 48);
    settings.period = 12;
    settings.amplitude = 2.5;
    const Heightfield along_x = make(settings);
    settings.along_y = true;
    const Heightfield along_y = make(settings);
    settings.kind = "eggcrate";
    const Heightfield crate = make(settings);
    for (int j = 0; j < 48; ++j)
        for (int i = 0; i < 48; ++i) {
            const double x = 2.5 * std::sin(2 * kPi * i / 12), y = 2.5 * std::sin(2 * kPi * j / 12);
            EXPECT_NEAR(along_x.at(i, j), x, 1e-6);
            EXPECT_NEAR(along_y.at(i, j), y, 1e-6);
            EXPECT_NEAR(crate.at(i, j), (x + y) / 2, 1e-6);
        }
}

// A tilt is a true slope: cells of 2 x 5 units do not change it, and heights grow with dx.
TEST(Shapes, TiltDoesNotDependOnTheCells) {
    SurfaceSettings settings = shape("pyramids", 12, 6, 40);
    settings.cell_x = 2;
    settings.cell_y = 5;
    for_facets(settings, [](int, int, Slope s) {
        EXPECT_NEAR(degrees(polar_angle(normal_of(s))), 40, 1e-4);
    });
    settings = settings_of("sinusoid", 16);
    settings.cell_x = settings.cell_y = 2;
    EXPECT_NEAR(make(settings).at(4, 0), 2, 1e-6);  // amplitude of one cell
}

TEST(Shapes, RepeatExactly) {
    for (const std::string kind : {"vgroove", "sawtooth", "pyramids", "sinusoid", "eggcrate"}) {
        const Heightfield s = make(shape(kind, 30, 10, 33));
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 20; ++i) {
                EXPECT_EQ(s.at(i, j), s.at(i + 10, j));
                EXPECT_EQ(s.at(i, j), s.at(i, j + 10));
            }
    }
}

}  // namespace
}  // namespace asperity
