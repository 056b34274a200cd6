// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/images/primaries.h>
#include <asperity/formats/test_files.h>
#include <gtest/gtest.h>

#include <limits>

namespace asperity::io::detail {
namespace {

using test::expect_error;

constexpr Primaries kAces0{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}};
constexpr Primaries kDisplayP3{{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, {0.3127, 0.329}};

// The matrices that the Academy (ACES2065-1 to linear Rec. 709) and SMPTE's P3 give, to their four
// digits; ours has primaries as rows.
TEST(Primaries, PublishedMatrices) {
    constexpr double kAces[3][3] = {{2.52169, -1.13413, -0.38756},
                                    {-0.27648, 1.37272, -0.09624},
                                    {-0.01538, -0.15298, 1.16835}};
    constexpr double kP3[3][3] = {
        {1.2249, -0.2249, 0}, {-0.0421, 1.0421, 0}, {-0.0197, -0.0786, 1.0983}};
    const auto aces = to_rec709(kAces0, "a"), p3 = to_rec709(kDisplayP3, "a");
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_NEAR(aces[j][i], kAces[i][j], 3e-4);
            EXPECT_NEAR(p3[j][i], kP3[i][j], 2e-4);
        }
    }
}

TEST(Primaries, OursLeaveEveryBit) {
    Image image{1, 1, {0.1f, -0.25f, 3e30f}};
    convert_to_rec709(image, {}, "a");
    EXPECT_EQ(image.rgb, (std::vector<float>{0.1f, -0.25f, 3e30f}));
}

// White stays white, what would be negative is cut, a NaN stays one.
TEST(Primaries, ConvertsPictures) {
    Image image{3, 1, {0.5f, 0.5f, 0.5f, 0, 1, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0}};
    convert_to_rec709(image, kAces0, "a");
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(image.rgb[k]), 0.5, 1e-4);
    EXPECT_EQ(image.rgb[3], 0.0f);
    EXPECT_NEAR(static_cast<double>(image.rgb[4]), 1.37272, 3e-4);
    EXPECT_NE(image.rgb[6], image.rgb[6]);
}

TEST(Primaries, RefusesThoseThatSpanNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Primaries& p : {Primaries{{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}},
                               Primaries{{nan, 0.3}, {0.3, 0.6}, {0.15, 0.06}, {0.3, 0.3}},
                               Primaries{{0.6, 0}, {0.3, 0.6}, {0.15, 0.06}, {0.3, 0.3}}})
        expect_error(ErrorCode::InvalidInput, "span no colours", [&] { to_rec709(p, "a"); });
}

}  // namespace
}  // namespace asperity::io::detail
