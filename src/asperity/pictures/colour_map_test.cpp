// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/colour_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

/// Relative luminance of an sRGB colour (IEC 61966-2-1, Rec. 709 primaries).
double luminance(Colour c) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

class EveryColourMap : public testing::TestWithParam<ColourMap> {};

TEST_P(EveryColourMap, LuminanceRisesWithTheValue) {
    for (int k = 0; k < 255; ++k) {
        const Colour below = colour_of(GetParam(), k / 255.0);
        const Colour above = colour_of(GetParam(), (k + 1) / 255.0);
        EXPECT_LT(luminance(below), luminance(above)) << "at " << k << " of 255";
    }
}

TEST_P(EveryColourMap, IsSmoothAndOnScreen) {
    for (int k = 0; k < 255; ++k) {
        const Colour a = colour_of(GetParam(), k / 255.0),
                     b = colour_of(GetParam(), (k + 1) / 255.0);
        for (const double value : {a.r, a.g, a.b}) EXPECT_TRUE(value >= 0 && value <= 1);
        const double step =
            std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
        EXPECT_LT(step, 0.03) << "at " << k << " of 255";
    }
}

TEST_P(EveryColourMap, LowestValueDiffersFromNothing) {
    const Colour lowest = colour_of(GetParam(), 0);
    EXPECT_GT(std::max({lowest.r, lowest.g, lowest.b}), 0.1);
    EXPECT_EQ(luminance(kZeroColour), 0);
}

TEST_P(EveryColourMap, ClampsOutsideItsRange) {
    EXPECT_EQ(colour_of(GetParam(), -3), colour_of(GetParam(), 0));
    EXPECT_EQ(colour_of(GetParam(), 7), colour_of(GetParam(), 1));
}

INSTANTIATE_TEST_SUITE_P(All, EveryColourMap,
                         testing::Values(ColourMap::Viridis, ColourMap::Inferno, ColourMap::Grey,
                                         ColourMap::ThesisRed));

TEST(ColourMap, GreyIsGreyAndThesisRedIsRed) {
    const Colour grey = colour_of(ColourMap::Grey, 0.5);
    EXPECT_NEAR(grey.r, grey.g, 1e-6);
    EXPECT_NEAR(grey.r, grey.b, 1e-6);
    const Colour red = colour_of(ColourMap::ThesisRed, 0.5);
    EXPECT_GT(red.r, 0.85);
    EXPECT_LT(red.g, 0.15);
    EXPECT_LT(red.b, 0.15);
}

}  // namespace
}  // namespace asperity::io
