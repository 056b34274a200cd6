// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/pictures/residual_sheet.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace asperity::io {
namespace {

TEST(ResidualSheet, ColoursTellWhichIsLarger) {
    const Colour equal = residual_colour(2, 2);
    EXPECT_EQ(residual_colour(0, 0), equal);
    EXPECT_EQ(residual_colour(4, 1), residual_colour(2, 1));  // twice and more are alike
    EXPECT_EQ(residual_colour(0, 1), residual_colour(1, 2));
    EXPECT_GT(residual_colour(2, 1).r, equal.r);
    EXPECT_LT(residual_colour(2, 1).b, equal.b);
    EXPECT_GT(residual_colour(1, 2).b, equal.b);
    EXPECT_NEAR(residual_colour(std::exp2(0.5), 1).r, 0.5 * (equal.r + residual_colour(2, 1).r),
                1e-12);
}

TEST(ResidualSheet, WritesAFileAndRefusesNothing) {
    const Detector detector(DetectorSettings{DetectorKind::LatLong, 16, 1});
    const std::string path = testing::TempDir() + "residuals.png";
    const std::vector<double> values(static_cast<std::size_t>(detector.cells()), 1.0);
    write_residual_sheet(detector, {{0.5, 0, values, values, "note"}}, "t", "l", path);
    EXPECT_GT(std::filesystem::file_size(path), 1000u);
    EXPECT_THROW(write_residual_sheet(detector, {}, "t", "l", path), Error);
}

}  // namespace
}  // namespace asperity::io
