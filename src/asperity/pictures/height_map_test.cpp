// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/height_map.h>

#include <gtest/gtest.h>

#include <cmath>

namespace asperity::io {
namespace {

Topography ramp(int nx, int ny) {
    Topography t;
    t.nx = nx;
    t.ny = ny;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) t.heights.push_back(10.0 * j + i);
    return t;
}

TEST(HeightMap, ShowsTheSampleInTheMiddleOfEachPixel) {
    const HeightMap map = height_map(ramp(4, 2), 2);
    ASSERT_EQ(map.width, 2);
    ASSERT_EQ(map.height, 1);
    // Middles at a quarter and three quarters of four columns, in the middle of two rows
    EXPECT_EQ(map.heights[0], 11);
    EXPECT_EQ(map.heights[1], 13);
    EXPECT_EQ(map.low, 0);
    EXPECT_EQ(map.high, 13);
    EXPECT_EQ(map.caption(), "4 × 2 samples · 4 cell × 2 cell");
}

TEST(HeightMap, LeavesOutWhatWasNotMeasured) {
    Topography t = ramp(3, 3);
    t.heights[8] = 1e9;  // beside `missing` a height means nothing
    t.mark_missing(8);
    const HeightMap map = height_map(t, 3);
    EXPECT_TRUE(std::isnan(map.heights[8]));
    EXPECT_EQ(map.heights[7], 21);
    EXPECT_EQ(map.high, 21);
    EXPECT_EQ(map.position(21), 1);
    EXPECT_EQ(map.position(10.5F), 0.5);
}

TEST(HeightMap, HasTheShapeOfTheSurfaceNotOfTheGrid) {
    Heightfield surface;
    surface.nx = surface.ny = 10;
    surface.dx = 1e-6;
    surface.dy = 3e-6;
    surface.unit = "m";
    surface.heights.assign(100, 2e-6F);
    const HeightMap map = height_map(surface, 30);
    EXPECT_EQ(map.width, 10);
    EXPECT_EQ(map.height, 30);
    EXPECT_EQ(map.position(2e-6F), 0.5);
    EXPECT_EQ(map.caption(), "10 × 10 samples · 10 um × 30 um");
}

}  // namespace
}  // namespace asperity::io
