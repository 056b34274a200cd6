// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/surface_testing.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using testing::make;
using testing::settings_of;

SurfaceSettings ridges(int size, int period, int land, double tilt_deg) {
    SurfaceSettings s = settings_of("ridges", size);
    s.period = period;
    s.tilt_deg = tilt_deg;
    s.own["land"] = std::int64_t{land};
    return s;
}

// All samples of a ridge lie on one circle that meets the land at the tilt.
TEST(Ridges, AreArcsOfACircle) {
    const int width = 20;
    const Heightfield s = make(ridges(48, 24, 4, 50));
    const double radius = width / (2 * std::sin(radians(50)));
    const double crest = radius * (1 - std::cos(radians(50))), middle = crest - radius;
    EXPECT_NEAR(s.at(10, 3), crest, 1e-5);
    for (int i = 0; i <= width; ++i)
        EXPECT_NEAR(std::hypot(i - 0.5 * width, double{s.at(i, 0)} - middle), radius, 1e-5);
    for (int i = width; i < 24; ++i) EXPECT_EQ(s.at(i, 5), 0);
    for (int i = 0; i < 24; ++i) EXPECT_EQ(s.at(i + 24, 0), s.at(i, 7));
}

// The sine of the tilt is uniform between those of the feet: its mean square is sin^2(tilt) / 3.
TEST(Ridges, TiltsAreUniformInTheirSine) {
    const int land = 512, period = 2048;
    const Heightfield s = make(ridges(2048, period, land, 60));
    double squares = 0, level = 0;
    for (int i = 0; i < period; ++i) {
        const double slope = static_cast<double>(s.at((i + 1) % period, 0) - s.at(i, 0));
        squares += slope * slope / (1 + slope * slope);
        level += slope == 0 ? 1 : 0;
    }
    const double sine = std::sin(radians(60));
    EXPECT_NEAR(squares / (period - land), sine * sine / 3, 1e-5);
    EXPECT_EQ(level, land);
}

TEST(Ridges, KeepTheirSlopesInCellsOfAnySize) {
    SurfaceSettings settings = ridges(32, 32, 0, 45);
    settings.along_y = true;
    const Heightfield square = make(settings);
    settings.cell_x = 2;
    settings.cell_y = 6;
    const Heightfield oblong = make(settings);
    for (int j = 0; j < 32; ++j) EXPECT_NEAR(oblong.at(0, j), 6 * square.at(0, j), 1e-4);
    settings.tilt_deg = 0;
    for (const float h : make(settings).heights) EXPECT_EQ(h, 0);
}

TEST(Ridges, RefuseLandThatLeavesNoRoom) {
    for (const int land : {13, 14, 15, 16}) {
        try {
            make(ridges(64, 16, land, 45));
            ADD_FAILURE() << land;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            EXPECT_EQ(error.where(), "land");
        }
    }
    EXPECT_NO_THROW(make(ridges(64, 16, 12, 45)));
}

}  // namespace
}  // namespace asperity
