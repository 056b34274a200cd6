// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/canvas.h>

#include <asperity/formats/test_files.h>
#include <asperity/pictures/picture_test_data.h>
#include <asperity/pictures/png_writer.h>

#include <numeric>

namespace asperity::io {
namespace {

using test::kBlack;
using test::kWhite;

/// Whole light on the canvas, in pixels of white.
double light(const Canvas& canvas) {
    return std::accumulate(canvas.bytes().begin(), canvas.bytes().end(), 0.0) / (3 * 255.0);
}

TEST(Canvas, RectanglesCoverTheirPixelsAndNoOthers) {
    Canvas canvas(8, 6, kBlack);
    canvas.fill({2, 1, 3, 2}, kWhite);
    EXPECT_EQ(canvas.get(2, 1), kWhite);
    EXPECT_EQ(canvas.get(4, 2), kWhite);
    EXPECT_EQ(canvas.get(5, 2), kBlack);
    EXPECT_EQ(canvas.get(4, 3), kBlack);
    EXPECT_DOUBLE_EQ(light(canvas), 6);
}

TEST(Canvas, LineThroughPixelCentresIsSharp) {
    Canvas canvas(10, 5, kBlack);
    canvas.line({0, 2.5}, {10, 2.5}, 1, kWhite);
    for (int x = 0; x < 10; ++x) EXPECT_EQ(canvas.get(x, 2), kWhite);
    EXPECT_DOUBLE_EQ(light(canvas), 10);
}

// A smooth edge may not change how much is painted: a disc of radius r covers pi r^2, a ring of
// width w covers 2 pi r w.
TEST(Canvas, SmoothShapesCoverTheirArea) {
    Canvas canvas(64, 64, kBlack);
    canvas.disc({31.3, 32.8}, 20, kWhite);
    EXPECT_NEAR(light(canvas), 1256.6, 4);
    Canvas other(64, 64, kBlack);
    other.circle({31.3, 32.8}, 20, 3, kWhite);
    EXPECT_NEAR(light(other), 377.0, 4);
}

TEST(Canvas, CrossingStrokesAreOneShape) {
    Canvas canvas(21, 21, kBlack);
    canvas.stroke({{{0, 10.5}, {21, 10.5}}, {{10.5, 0}, {10.5, 21}}}, 3, kWhite, 0.5);
    EXPECT_EQ(canvas.get(10, 10), canvas.get(3, 10));
}

TEST(Canvas, WhatLiesOutsideIsLeftOut) {
    Canvas canvas(4, 4, kBlack);
    canvas.line({-100, -100}, {200, 200}, 2, kWhite);
    canvas.disc({50, 50}, 10, kWhite);
    canvas.fill({-5, -5, 2, 2}, kWhite);
    canvas.frame({0, 0, 4, 4}, kWhite);
    EXPECT_EQ(canvas.get(0, 0), kWhite);
    EXPECT_EQ(canvas.get(3, 0), kBlack);
}

TEST(PngWriter, ReadsBackThroughLibpng) {
    const test::TemporaryFolder folder;
    Canvas canvas(5, 3, {0.2, 0.4, 0.6});
    canvas.set(4, 0, {1, 0, 0});
    write_png(canvas, folder / "a.png");
    const test::ReadPng png(folder / "a.png");
    EXPECT_EQ(png.width, 5);
    EXPECT_EQ(png.height, 3);
    EXPECT_EQ(png.at(4, 0), (std::vector<int>{255, 0, 0}));
    EXPECT_EQ(png.at(0, 2), (std::vector<int>{51, 102, 153}));
    EXPECT_EQ(folder.files(), 1);
}

TEST(PngWriter, RefusedPlacesGiveOneLineAndNoFile) {
    const test::TemporaryFolder folder;
    const Canvas canvas(5, 3, kBlack);
    test::expect_error(ErrorCode::InputOutput, "missing",
                       [&] { write_png(canvas, folder / "missing/a.png"); });
    test::expect_error(ErrorCode::InputOutput, folder.path(),
                       [&] { write_png(canvas, folder.path()); });
    EXPECT_EQ(folder.files(), 0);
}

TEST(PngWriter, FullDiskIsReportedAndLeavesNothing) {
    const test::TemporaryFolder folder;
    const Canvas canvas(500, 300, kBlack);
    const test::FileSizeLimit limit(64);
    test::expect_error(ErrorCode::InputOutput, "a.png",
                       [&] { write_png(canvas, folder / "a.png"); });
    EXPECT_EQ(folder.files(), 0);
}

}  // namespace
}  // namespace asperity::io
