// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/stroke_font.h>

#include <asperity/pictures/picture_test_data.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace asperity::io {
namespace {

using test::kBlack;
using test::kWhite;

/// The smallest rectangle that holds all that is not black.
Rect inked(const Canvas& canvas) {
    int left = canvas.width(), right = 0, top = canvas.height(), bottom = 0;
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            if (canvas.get(x, y).r < 0.2) continue;
            left = std::min(left, x), right = std::max(right, x + 1);
            top = std::min(top, y), bottom = std::max(bottom, y + 1);
        }
    }
    return {left, top, right - left, bottom - top};
}

Rect inked(const char* text, double size, Align align = Align::Left) {
    Canvas canvas(400, 80, kBlack);
    draw_text(canvas, {200, 50}, text, {size, kWhite}, align);
    return inked(canvas);
}

TEST(StrokeFont, HasEverySignItIsAskedFor) {
    for (char32_t code = U' '; code <= U'~'; ++code) EXPECT_TRUE(has_glyph(code)) << int(code);
    for (const char32_t code : U"°·×±−µ≤≥…θφασλ⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵢₒ")
        EXPECT_TRUE(code == 0 || has_glyph(code)) << std::hex << static_cast<unsigned>(code);
    EXPECT_FALSE(has_glyph(U'漢'));
}

TEST(StrokeFont, EverySignButTheBlankHasInkWithinItsLine) {
    for (char32_t code = U'!'; code <= U'~'; ++code) {
        const Glyph& glyph = glyph_of(code);
        ASSERT_FALSE(glyph.lines.empty()) << int(code);
        for (const Polyline& line : glyph.lines) {
            for (const Point p : line) {
                EXPECT_TRUE(p.y >= -3.2 && p.y <= 11.7) << int(code);
                EXPECT_TRUE(p.x >= -0.4 && p.x <= glyph.width + 0.4) << int(code);
            }
        }
    }
}

TEST(StrokeFont, CapitalsStandOnTheBaseline) {
    // 20 pixels: capitals are 14.4 high, 14 on the grid, plus the width of a stroke (1.9).
    const Rect box = inked("H", 20);
    EXPECT_EQ(box.bottom(), 51);
    EXPECT_NEAR(box.height, 16, 1);
}

TEST(StrokeFont, DigitsAreEquallyWide) {
    for (const char* digit : {"0", "2", "3", "4", "5", "6", "7", "8", "9"})
        EXPECT_EQ(text_width(digit, 14), text_width("1", 14));
}

TEST(StrokeFont, AlignsTextAtItsPlace) {
    const double width = text_width("theta", 16);
    EXPECT_NEAR(inked("theta", 16, Align::Left).x, 200, 3);
    EXPECT_NEAR(inked("theta", 16, Align::Right).right(), 200, 3);
    EXPECT_NEAR(inked("theta", 16, Align::Centre).centre().x, 200, 2);
    EXPECT_NEAR(inked("theta", 16).width, width, 4);
}

TEST(StrokeFont, NeighboursDoNotTouch) {
    for (const char* pair : {"ll", "nn", "oo", "HH", "00", "il", "mm"}) {
        Canvas canvas(80, 40, kBlack);
        draw_text(canvas, {10, 25}, pair, {13, kWhite});
        const double middle = 10 + text_width(pair, 13) / 2;
        bool gap = false;
        for (int x = static_cast<int>(middle) - 2; x <= static_cast<int>(middle) + 2; ++x) {
            bool empty = true;
            for (int y = 0; y < 40; ++y) empty = empty && canvas.get(x, y).r < 0.25;
            gap = gap || empty;
        }
        EXPECT_TRUE(gap) << pair;
    }
}

TEST(StrokeFont, UnknownAndBrokenTextIsDrawnAsBoxes) {
    EXPECT_GT(text_width("漢", 14), 0);
    EXPECT_GT(text_width("\xff\xfe\xc3", 14), text_width("\xff", 14));
    EXPECT_GT(inked("\xe6\xbc", 14).width, 0);
}

TEST(StrokeFont, LongTitlesStayWhole) {
    const std::string text = "a surface with a rather long name";
    EXPECT_EQ(fitting_size(text, 14, 1000), 14);
    const double size = fitting_size(text, 14, 120);
    EXPECT_LT(size, 14);
    EXPECT_NEAR(text_width(text, size), 120, 2);
    const std::vector<std::string> lines = wrapped(text, 14, 120);
    ASSERT_GT(lines.size(), 1u);
    std::string joined;
    for (const std::string& line : lines) {
        EXPECT_LE(text_width(line, 14), 120);
        joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, text);
}

}  // namespace
}  // namespace asperity::io
