// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/formats/test_files.h>
#include <asperity/pictures/picture_test_data.h>
#include <asperity/pictures/pictures.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace asperity::io {
namespace {

using test::ReadPng;

template <typename Height>
Heightfield surface_of(int nx, int ny, Height&& height) {
    Heightfield s;
    s.nx = nx, s.ny = ny;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) s.heights.push_back(static_cast<float>(height(i, j)));
    return s;
}

TEST(SurfacePng, FlatSurfaceIsPureGreenInTheThesisLook) {
    const test::TemporaryFolder folder;
    write_surface_png(surface_of(8, 8, [](int, int) { return 3; }), folder / "a.png",
                      SurfaceLook::Normals);
    const ReadPng png(folder / "a.png");
    EXPECT_EQ(png.width, 1024);
    EXPECT_EQ(png.at(500, 500), (std::vector<int>{0, 255, 0}));
}

// The tilt that was measured is a run of colours on the left; on the right all is alike but for a
// peak. What was not measured is black.
TEST(SurfacePng, BeforeAndAfterStandSideBySide) {
    const test::TemporaryFolder folder;
    Topography before;
    before.nx = before.ny = 16;
    before.dx = before.dy = 1e-6;
    before.unit = "m";
    for (int k = 0; k < 256; ++k) before.heights.push_back(1e-7 * (k % 16));
    before.heights[8 * 16 + 8] += 1e-5;
    before.mark_missing(0);
    const Heightfield after = prepare(before, {}, "made", asperity::Run(1));
    write_before_after_png(before, after, folder / "a.png");
    const ReadPng png(folder / "a.png");
    EXPECT_EQ(png.at(36 + 5, 76 + 5), (std::vector<int>{0, 0, 0}));
    const auto green = [&](int left, int i, int j) {
        return png.at(left + 20 + i * 620 / 16, 76 + 20 + j * 620 / 16)[1];
    };
    EXPECT_GT(green(36, 8, 8), 200);  // yellow
    EXPECT_GT(green(36, 15, 3), green(36, 1, 3) + 10);
    EXPECT_GT(green(72 + 620, 8, 8), 200);
    EXPECT_NEAR(green(72 + 620, 15, 3), green(72 + 620, 1, 3), 5);
}

// Slope 1 along x: normal (-1, 0, 1) / sqrt(2), so red = green = 180 of 255, blue = 0. Along y,
// blue takes the place of red.
TEST(SurfacePng, SlopesAlongXAreRedAlongYBlue) {
    const test::TemporaryFolder folder;
    write_surface_png(surface_of(64, 64, [](int i, int) { return i; }), folder / "x.png",
                      SurfaceLook::Normals);
    EXPECT_EQ(ReadPng(folder / "x.png").at(100, 100), (std::vector<int>{180, 180, 0}));
    write_surface_png(surface_of(64, 64, [](int, int j) { return j; }), folder / "y.png",
                      SurfaceLook::Normals);
    EXPECT_EQ(ReadPng(folder / "y.png").at(100, 100), (std::vector<int>{0, 180, 180}));
}

// One raised sample at (1, 0) of 4 x 4: for the anti-diagonal cell (0, 0) is cut from its upper
// right to its lower left corner. Lower triangle: slope (1, 0); upper: right edge falls, (0, -1).
TEST(SurfacePng, ShowsBothTrianglesOfACellAndRowZeroOnTop) {
    const test::TemporaryFolder folder;
    Heightfield s = surface_of(4, 4, [](int i, int j) { return i == 1 && j == 0 ? 1 : 0; });
    write_surface_png(s, folder / "a.png", SurfaceLook::Normals);
    const ReadPng anti(folder / "a.png");
    ASSERT_EQ(anti.width, 1024);
    EXPECT_EQ(anti.at(40, 40), (std::vector<int>{180, 180, 0}));
    EXPECT_EQ(anti.at(220, 220), (std::vector<int>{0, 180, 180}));
    EXPECT_EQ(anti.at(40, 600), (std::vector<int>{0, 255, 0}));
    // Cut from upper left to lower right: lower triangle (0,0), (1,0), (1,1): slope (1, -1); the
    // other one does not touch the raised sample.
    s.diagonal = Diagonal::Main;
    write_surface_png(s, folder / "b.png", SurfaceLook::Normals);
    const ReadPng main(folder / "b.png");
    EXPECT_EQ(main.at(220, 40), (std::vector<int>{147, 147, 147}));
    EXPECT_EQ(main.at(40, 220), (std::vector<int>{0, 255, 0}));
}

// 4096 cells at 4 a pixel. Stripes of slope +1 and -1 one cell wide: |n| is the same everywhere.
TEST(SurfacePng, LargeSurfacesAreAveraged) {
    const test::TemporaryFolder folder;
    write_surface_png(surface_of(4096, 6, [](int i, int) { return i % 2; }), folder / "a.png",
                      SurfaceLook::Normals);
    const ReadPng png(folder / "a.png");
    EXPECT_EQ(png.width, 1024);
    EXPECT_EQ(png.height, 2);  // 6 rows at 4: the last pixel covers two
    EXPECT_EQ(png.at(700, 1), (std::vector<int>{180, 180, 0}));
}

TEST(SurfacePng, LightComesFromTheUpperLeft) {
    const test::TemporaryFolder folder;
    // A ridge along the diagonal of the picture: its upper left flank is lit.
    const auto ridge = [](int i, int j) { return 8 - std::abs(i + j - 16) / 2.0; };
    write_surface_png(surface_of(16, 16, ridge), folder / "a.png", SurfaceLook::Shaded);
    const ReadPng png(folder / "a.png");
    const auto light = [&](int i, int j) {
        const auto c = png.at(64 * i + 32, 64 * j + 20);
        return c[0] + c[1] + c[2];
    };
    EXPECT_GT(light(6, 6), light(9, 9) + 100);
    EXPECT_GT(light(6, 6), light(2, 2));  // and high places are brighter than deep ones
}

TEST(SurfacePng, FinitePatchHasNoLastCell) {
    const test::TemporaryFolder folder;
    Heightfield s = surface_of(5, 3, [](int, int) { return 0; });
    s.boundary = Boundary::Finite;
    write_surface_png(s, folder / "a.png", SurfaceLook::Shaded);
    const ReadPng png(folder / "a.png");
    EXPECT_EQ(png.width, 1024);
    EXPECT_EQ(png.height, 512);
}

TEST(SurfacePng, RefusesBrokenSurfacesAndPlaces) {
    const test::TemporaryFolder folder;
    Heightfield s = surface_of(4, 4, [](int, int) { return 0; });
    test::expect_error(ErrorCode::InputOutput, "nowhere", [&] {
        write_surface_png(s, folder / "nowhere/a.png", SurfaceLook::Shaded);
    });
    s.heights[3] = std::nanf("");
    test::expect_error(ErrorCode::InvalidInput, "a.png",
                       [&] { write_surface_png(s, folder / "a.png", SurfaceLook::Normals); });
    EXPECT_EQ(folder.files(), 0);
}

// A smooth wave at 4 pixels a cell. Facets of 4 pixels would make steps and, from triangle to
// triangle, a weave; a smooth slope changes by little from pixel to pixel.
TEST(SurfacePng, SmallFacetsAreNoWeave) {
    const test::TemporaryFolder folder;
    const auto wave = [](int i, int j) {
        return 4 * std::cos(2 * kPi * i / 32) * std::cos(2 * kPi * j / 32);
    };
    write_surface_png(surface_of(256, 256, wave), folder / "a.png", SurfaceLook::Shaded);
    const ReadPng png(folder / "a.png");
    ASSERT_EQ(png.width, 1024);
    int most = 0, darkest = 255, brightest = 0;
    for (int y = 100; y < 400; y += 7)
        for (int x = 101; x < 400; ++x) {
            const int before = png.at(x - 1, y)[0], here = png.at(x, y)[0];
            most = std::max(most, std::abs(png.at(x + 1, y)[0] - 2 * here + before));
            darkest = std::min(darkest, here);
            brightest = std::max(brightest, here);
        }
    EXPECT_LE(most, 3);
    EXPECT_GT(brightest - darkest, 100);
}

// 256 cells of 2 micrometres at 4 pixels: the bar is the first 1, 2 or 5 below a quarter, 100 um,
// and so 50 cells, 200 pixels long. The title keeps its place for the picture below it.
TEST(SurfacePng, AReliefHasAScaleBarAndAKey) {
    const test::TemporaryFolder folder;
    Heightfield s = surface_of(256, 256, [](int i, int) { return 1e-6 * std::sin(0.2 * i); });
    s.dx = s.dy = 2e-6;
    s.unit = "m";
    s.name = "a wave";
    for (const bool dark : {false, true}) {
        write_relief_png(s, folder / "a.png", dark);
        const ReadPng png(folder / "a.png");
        EXPECT_EQ(png.width, 1024 + 2 * 28);
        EXPECT_EQ(png.at(2, 2)[0] < 128, dark);
        const int y = 28 + 26 + 30 + 1024 + 22;  // within the bar
        const auto inked = [&](int x) { return std::abs(png.at(x, y)[0] - png.at(2, 2)[0]) > 100; };
        EXPECT_FALSE(inked(26));
        EXPECT_TRUE(inked(29));
        EXPECT_TRUE(inked(28 + 198));
        EXPECT_FALSE(inked(28 + 202));
        // Cold on the left of the key, warm on the right
        const auto cold = png.at(1052 - 318, y), warm = png.at(1052 - 3, y);
        EXPECT_GT(cold[2], cold[0]);
        EXPECT_GT(warm[0], warm[2]);
    }
}

}  // namespace
}  // namespace asperity::io
