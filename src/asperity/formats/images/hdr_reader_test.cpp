// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/images/image_test_damage.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io {
namespace {

using namespace std::string_literals;
using test::expect_error;
using test::expect_survives_damage;
using test::put;
using test::TemporaryFolder;

std::string hdr_header(const std::string& resolution, const std::string& lines = "") {
    return "#?RADIANCE\n# made by a test\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution +
           "\n";
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text.push_back(static_cast<char>(value));
    return text;
}

/// Radiance k exactly, 2 k * 2^(135 - 136); mantissas of 1 would be a repetition.
std::string grey_pixel(int k) {
    return bytes({2 * k, 2 * k, 2 * k, 135});
}

Image read_hdr(const std::string& content) {
    const TemporaryFolder folder;
    put(folder / "a.hdr", content);
    return read_image(folder / "a.hdr");
}

void expect_hdr_refused(const std::string& content, const std::string& why) {
    const TemporaryFolder folder;
    put(folder / "a.hdr", content);
    expect_error(ErrorCode::InvalidInput, why, [&] { read_image(folder / "a.hdr"); });
}

// m * 2^(e - 136): 128 * 2^-7 = 1, 64 * 2^-7 = 0.5, 3 * 2^-7; exponent 0 is black.
TEST(HdrReader, PixelsAreMantissasAndAnExponent) {
    const Image image =
        read_hdr(hdr_header("-Y 1 +X 2") + bytes({128, 64, 3, 129}) + bytes({200, 100, 50, 0}));
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 1);
    EXPECT_EQ(image.at(0, 0), (Rgb{1, 0.5, 3 / 128.0}));
    EXPECT_EQ(image.at(1, 0), Rgb{});
    // The brightest there is
    const Image most = read_hdr(hdr_header("-Y 1 +X 1") + bytes({255, 255, 255, 255}));
    EXPECT_EQ(most.at(0, 0).r, std::ldexp(255.0, 119));
}

TEST(HdrReader, UndoesAllExposures) {
    const Image image =
        read_hdr(hdr_header("-Y 1 +X 1", "EXPOSURE=4\nEXPOSURE= 0.5\n") + bytes({128, 64, 3, 129}));
    EXPECT_EQ(image.at(0, 0), (Rgb{0.5, 0.25, 1.5 / 128}));
}

// Every line counts, as with exposures, for each colour.
TEST(HdrReader, UndoesCorrectionsOfColour) {
    const Image image = read_hdr(hdr_header("-Y 1 +X 1", "COLORCORR= 2 1 0.5\nCOLORCORR=1 2 1\n") +
                                 bytes({128, 64, 32, 129}));
    EXPECT_EQ(image.at(0, 0), (Rgb{0.5, 0.25, 0.5}));
    expect_hdr_refused(hdr_header("-Y 1 +X 1", "COLORCORR=1 0 1\n") + bytes({1, 2, 3, 129}),
                       "cannot be undone");
    expect_hdr_refused(hdr_header("-Y 1 +X 1", "COLORCORR=1 1\n") + bytes({1, 2, 3, 129}),
                       "cannot be undone");
}

// Radiance's own: equal parts are its white, and ours stays white.
TEST(HdrReader, BringsPrimariesToOurs) {
    const std::string line = "PRIMARIES= 0.64 0.33 0.29 0.6 0.15 0.06 0.3333 0.3333\n";
    const Image image = read_hdr(hdr_header("-Y 1 +X 1", line) + bytes({128, 128, 128, 129}));
    EXPECT_NEAR(image.at(0, 0).r, 1, 1e-4);
    EXPECT_NEAR(image.at(0, 0).g, 1, 1e-4);
    EXPECT_NEAR(image.at(0, 0).b, 1, 1e-4);
    for (const char* wrong : {"1 2 3", "0.3 0.3 0.3 0.3 0.3 0.3 0.3 0.3", "a b c d e f g h",
                              "0.64 0 0.29 0.6 0.15 0.06 0.33 0.33"})
        expect_hdr_refused(
            hdr_header("-Y 1 +X 1", fmt::format("PRIMARIES={}\n", wrong)) + bytes({1, 2, 3, 129}),
            "");
}

// The picture   1 2 3   as a viewer sees it, written in each of the eight orders.
//               4 5 6
TEST(HdrReader, KnowsAllEightOrientations) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"-Y 2 +X 3", "123456"}, {"-Y 2 -X 3", "321654"}, {"+Y 2 +X 3", "456123"},
        {"+Y 2 -X 3", "654321"}, {"+X 3 -Y 2", "142536"}, {"+X 3 +Y 2", "415263"},
        {"-X 3 -Y 2", "362514"}, {"-X 3 +Y 2", "635241"},
    };
    for (const auto& [resolution, order] : files) {
        std::string pixels;
        for (const char digit : order) pixels += grey_pixel(digit - '0');
        const Image image = read_hdr(hdr_header(resolution) + pixels);
        ASSERT_EQ(image.width, 3) << resolution;
        ASSERT_EQ(image.height, 2) << resolution;
        for (int k = 0; k < 6; ++k)
            EXPECT_EQ(image.at(k % 3, k / 3).g, k + 1) << resolution << ' ' << k;
    }
}

// Ten pixels: red a run of ten 1s; green 5 single bytes and a run of five; blue ten single bytes.
TEST(HdrReader, NewRunLengths) {
    const std::string line = bytes({2, 2, 0, 10}) + bytes({128 + 10, 1}) +
                             bytes({5, 1, 2, 3, 4, 5, 128 + 5, 7}) +
                             bytes({10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}) + bytes({128 + 10, 136});
    const Image image = read_hdr(hdr_header("-Y 2 +X 10") + line + line);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 10; ++x) {
            EXPECT_EQ(image.at(x, y).r, 1);
            EXPECT_EQ(image.at(x, y).g, x < 5 ? x + 1 : 7);
            EXPECT_EQ(image.at(x, y).b, 9 - x);
        }
    }
}

// A repetition of 44 + 1 * 256 = 300 pixels after the first.
TEST(HdrReader, OldRunLengths) {
    const std::string line =
        grey_pixel(5) + bytes({1, 1, 1, 44}) + bytes({1, 1, 1, 1}) + grey_pixel(6);
    const Image image = read_hdr(hdr_header("-Y 1 +X 302") + line);
    for (int x = 0; x < 301; ++x) ASSERT_EQ(image.at(x, 0).r, 5);
    EXPECT_EQ(image.at(301, 0).r, 6);
    // Counts of nothing are passed over
    const Image empty_runs =
        read_hdr(hdr_header("-Y 1 +X 2") + grey_pixel(5) + bytes({1, 1, 1, 0}) + grey_pixel(6));
    EXPECT_EQ(empty_runs.at(1, 0).r, 6);
}

TEST(HdrReader, SaysWhatIsWrong) {
    expect_hdr_refused("", "a.hdr: it is none of: OpenEXR, Radiance HDR");
    expect_hdr_refused("GIF89a", "it is none of: OpenEXR, Radiance HDR");
    expect_hdr_refused("#?", "a.hdr:0: the file ends inside the header");
    expect_hdr_refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n",
                       "the format '32-bit_rle_xyze' is not read");
    for (const char* exposure : {"0", "-1", "nan", "bright", "1e200", ""})
        expect_hdr_refused(hdr_header("-Y 1 +X 1", "EXPOSURE="s + exposure + "\n"),
                           "cannot be undone");
    for (const char* resolution : {"", "-Y 1", "-Y 1 +X", "-Y 1 +X 1 1", "-Z 1 +X 1", "Y 1 X 1"})
        expect_hdr_refused(hdr_header(resolution) + grey_pixel(1), "-Y height +X width");
    expect_hdr_refused(hdr_header("-Y 1 +Y 1") + grey_pixel(1), "names an axis twice");
    expect_hdr_refused(hdr_header("-Y 0 +X 1"), "1 x 0 pixels");
    expect_hdr_refused(hdr_header("-Y 1 +X 40000"), "a side of '40000' pixels");
    expect_hdr_refused(hdr_header("-Y 1 +X 99999999999999999999"), "a side of");
    expect_hdr_refused(hdr_header("-Y 1 +X -5"), "a side of '-5' pixels");
    expect_hdr_refused(hdr_header("-Y 32768 +X 32768"), "268435456 in all are allowed");
    expect_hdr_refused(hdr_header("-Y 8192 +X 32768") + std::string(32768, '\x09'),
                       "ends inside the pixels");
    // A run of 32767 pixels in 12 bytes, over and over, with as many bytes behind as one likes
    std::string bomb = hdr_header("-Y 8000 +X 32767");
    for (int y = 0; y < 8000; ++y) bomb += grey_pixel(9) + bytes({1, 1, 1, 254, 1, 1, 1, 127});
    expect_hdr_refused(bomb + std::string(1 << 20, '\1'), "32767 x 8000 pixels out of 96000 bytes");
    expect_hdr_refused(hdr_header("-Y 2 +X 1") + grey_pixel(1), "1 x 2 pixels do not fit a file");
    expect_hdr_refused(hdr_header("-Y 1 +X 2") + grey_pixel(1), "ends inside the pixels");
    expect_hdr_refused(hdr_header("-Y 1 +X 2") + bytes({1, 1, 1, 2}), "begins with a repetition");
    expect_hdr_refused(hdr_header("-Y 1 +X 3") + grey_pixel(9) + bytes({1, 1, 1, 3}),
                       "a run goes beyond its line");
    std::string digits = hdr_header("-Y 1 +X 3") + grey_pixel(9);
    for (int k = 0; k < 5; ++k) digits += bytes({1, 1, 1, 0});
    expect_hdr_refused(digits, "too many digits");
    const std::string header = hdr_header("-Y 1 +X 10");
    expect_hdr_refused(header + bytes({2, 2, 0, 11}), "a line of 11 pixels, all have 10");
    expect_hdr_refused(header + bytes({2, 2, 0, 10, 0}), "a run of no pixels");
    expect_hdr_refused(header + bytes({2, 2, 0, 10, 128}) + std::string(200, '\1'),
                       "a run goes beyond its line");
    expect_hdr_refused(header + bytes({2, 2, 0, 10, 128 + 11, 1}), "a run goes beyond its line");
}

TEST(HdrReader, SurvivesDamage) {
    const TemporaryFolder folder;
    const std::string line = bytes({2, 2, 0, 10}) + bytes({128 + 10, 1}) +
                             bytes({5, 1, 2, 3, 4, 5, 128 + 5, 7}) +
                             bytes({10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}) + bytes({128 + 10, 136});
    put(folder / "new.hdr", hdr_header("-Y 3 +X 10", "EXPOSURE=2\n") + line + line + line);
    expect_survives_damage(folder / "new.hdr", 2000);
    put(folder / "old.hdr", hdr_header("+X 4 -Y 9") + grey_pixel(3) + bytes({1, 1, 1, 8}) +
                                grey_pixel(3) + bytes({1, 1, 1, 3}) + grey_pixel(4) +
                                bytes({1, 1, 1, 4}) + grey_pixel(9) + bytes({1, 1, 1, 8}) +
                                grey_pixel(9) + bytes({1, 1, 1, 8}));
    expect_survives_damage(folder / "old.hdr", 2000);
}

}  // namespace
}  // namespace asperity::io
