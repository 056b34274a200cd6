// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <asperity/core/random.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/test_files.h>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <span>

namespace asperity::io {
namespace {

using namespace std::string_literals;
using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

// --- Radiance HDR -------------------------------------------------------------------------------

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

// --- OpenEXR ------------------------------------------------------------------------------------

struct Channel {
    std::string name;
    Imf::PixelType type = Imf::FLOAT;
    int sampling = 1;
};

/// The value of a test picture's channel: exact in half too.
float value_at(std::size_t channel, int x, int y) {
    return static_cast<float>(100 * static_cast<int>(channel) + 10 * y + x) / 8;
}

/// 7 x 5 pixels that begin at (-3, 2).
const Imath::Box2i kDataWindow({-3, 2}, {3, 6});

void write_exr(const std::string& path, const std::vector<Channel>& channels,
               Imf::Compression compression = Imf::ZIP_COMPRESSION, bool tiles = false,
               const Imath::Box2i& shown = kDataWindow) {
    constexpr int kWidth = 7, kHeight = 5;
    const Imath::Box2i window = kDataWindow;
    Imf::Header header(shown, window);
    header.compression() = compression;
    if (tiles) header.setTileDescription({4, 4, Imf::ONE_LEVEL});
    Imf::FrameBuffer frame;
    std::vector<std::vector<float>> planes;
    std::vector<std::vector<std::uint32_t>> words(1, std::vector<std::uint32_t>(35, 1));
    for (std::size_t c = 0; c < channels.size(); ++c) {
        planes.emplace_back();
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) planes.back().push_back(value_at(c, x, y));
    }
    std::vector<std::vector<Imath::half>> halves(channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const Channel& channel = channels[c];
        header.channels().insert(channel.name,
                                 Imf::Channel(channel.type, channel.sampling, channel.sampling));
        for (const float value : planes[c]) halves[c].emplace_back(value);
        char* data = reinterpret_cast<char*>(planes[c].data());
        if (channel.type == Imf::HALF) data = reinterpret_cast<char*>(halves[c].data());
        if (channel.type == Imf::UINT) data = reinterpret_cast<char*>(words[0].data());
        const std::size_t size = channel.type == Imf::HALF ? 2 : 4;
        frame.insert(channel.name, Imf::Slice::Make(channel.type, data, window, size, size * kWidth,
                                                    channel.sampling, channel.sampling));
    }
    if (tiles) {
        Imf::TiledOutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(kHeight);
    }
}

TEST(ExrReader, ReadsRedGreenAndBlueOfAllKinds) {
    const TemporaryFolder folder;
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
        for (const Imf::Compression compression :
             {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
              Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
            for (const bool tiles : {false, true}) {
                // Left out: alpha, a depth of integers, another layer's red
                write_exr(folder / "a.exr",
                          {{"R", type},
                           {"G", type},
                           {"B", type},
                           {"A", Imf::HALF},
                           {"id", Imf::UINT},
                           {"other.R", Imf::FLOAT}},
                          compression, tiles);
                const Image image = read_image(folder / "a.exr");
                ASSERT_EQ(image.width, 7);
                ASSERT_EQ(image.height, 5);
                for (int y = 0; y < 5; ++y)
                    for (int x = 0; x < 7; ++x)
                        for (std::size_t c = 0; c < 3; ++c)
                            ASSERT_EQ(image.rgb[static_cast<std::size_t>(3 * (7 * y + x)) + c],
                                      value_at(c, x, y));
            }
        }
    }
}

TEST(ExrReader, LuminanceAloneIsGrey) {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {{"Y", Imf::FLOAT}, {"Z", Imf::FLOAT}});
    const Image image = read_image(folder / "a.exr");
    const auto y = static_cast<double>(value_at(0, 6, 4));
    EXPECT_EQ(image.at(6, 4), (Rgb{y, y, y}));
}

// Other programs' names: small letters, whole words, the only layer of a file.
TEST(ExrReader, FindsColoursByOtherNames) {
    const TemporaryFolder folder;
    const std::vector<std::vector<Channel>> named = {
        {{"r"}, {"g"}, {"b"}},
        {{"red"}, {"green"}, {"blue"}},
        {{"ViewLayer.Combined.R"},
         {"ViewLayer.Combined.G"},
         {"ViewLayer.Combined.B"},
         {"ViewLayer.Depth.Z"}},
        {{"R"}, {"G"}, {"B"}, {"specular.R"}, {"specular.G"}, {"specular.B"}}};
    for (const auto& channels : named) {
        write_exr(folder / "a.exr", channels);
        const Image image = read_image(folder / "a.exr");
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(image.rgb[c], value_at(c, 0, 0));
    }
    const auto refused = [&](const std::vector<Channel>& channels, const std::string& why) {
        write_exr(folder / "a.exr", channels);
        expect_error(ErrorCode::InvalidInput, why, [&] { read_image(folder / "a.exr"); });
    };
    refused({{"a.R"}, {"a.G"}, {"a.B"}, {"b.R"}, {"b.G"}, {"b.B"}}, "several layers ('a', 'b')");
    refused({{"a.R"}, {"b.G"}, {"b.B"}}, "no channels R, G and B");
    refused({{"Y"}, {"RY"}, {"BY"}}, "luminance and chroma");
}

// A crop of a panorama stays at its place, and what is missing is black; overscan is cut off.
TEST(ExrReader, ShowsTheDisplayWindow) {
    const TemporaryFolder folder;
    const std::vector<Channel> channels = {{"R"}, {"G"}, {"B"}};
    for (const bool tiles : {false, true}) {
        for (const Imath::Box2i& shown :
             {Imath::Box2i({-5, 0}, {5, 9}), Imath::Box2i({-1, 3}, {2, 4}),
              Imath::Box2i({0, 0}, {20, 20}), Imath::Box2i({3, 6}, {3, 6})}) {
            write_exr(folder / "a.exr", channels, Imf::ZIP_COMPRESSION, tiles, shown);
            const Image image = read_image(folder / "a.exr");
            ASSERT_EQ(image.width, shown.max.x - shown.min.x + 1);
            ASSERT_EQ(image.height, shown.max.y - shown.min.y + 1);
            for (int y = shown.min.y; y <= shown.max.y; ++y) {
                for (int x = shown.min.x; x <= shown.max.x; ++x) {
                    const bool there = kDataWindow.intersects(Imath::V2i(x, y));
                    const auto g = there ? static_cast<double>(value_at(1, x + 3, y - 2)) : 0;
                    ASSERT_EQ(image.at(x - shown.min.x, y - shown.min.y).g, g) << x << ' ' << y;
                }
            }
        }
    }
    const auto refused = [&](const Imath::Box2i& shown, const std::string& why) {
        write_exr(folder / "a.exr", channels, Imf::ZIP_COMPRESSION, false, shown);
        expect_error(ErrorCode::InvalidInput, why, [&] { read_image(folder / "a.exr"); });
    };
    refused({{50, 50}, {60, 60}}, "no pixel lies in its display window");
    refused({{0, 0}, {32767, 8191}}, "32768 x 8192 pixels are shown, 35 are there");
    refused({{0, 0}, {32768, 0}}, "1 to 32768 on a side");
}

// A format of a user's own comes before ours.
TEST(ImageReader, AProgramAddsARow) {
    const TemporaryFolder folder;
    ImageReadSettings settings;
    settings.formats = {{"grey by a word",
                         {".grey"},
                         [](const FileStart& start) { return start.bytes.starts_with("grey"); },
                         [](const std::string&) {
                             return Image{1, 1, {0.5f, 0.5f, 0.5f}};
                         }}};
    put(folder / "a.exr", "grey");
    EXPECT_EQ(read_image(folder / "a.exr", settings).at(0, 0).g, 0.5);
    expect_error(ErrorCode::InvalidInput, "none of", [&] { read_image(folder / "a.exr"); });
}

TEST(ExrReader, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.exr";
    const auto refused = [&](const std::string& why) {
        expect_error(ErrorCode::InvalidInput, "a.exr: " + why, [&] { read_image(path); });
    };
    write_exr(path, {{"R"}, {"G"}});
    refused("no channels R, G and B, nor Y");
    write_exr(path, {{"R"}, {"G"}, {"B", Imf::UINT}});
    refused("channel 'B' holds integers");
    write_exr(path, {{"Y"}});
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
    refused("");
    expect_error(ErrorCode::InputOutput, "b.exr: cannot open",
                 [&] { read_image(folder / "b.exr"); });
    expect_error(ErrorCode::InputOutput, "folder", [&] { read_image(folder.path()); });
}

TEST(ExrReader, RefusesSubsampledChannels) {
    const TemporaryFolder folder;
    // Only windows whose corners are multiples of 2 may be subsampled
    Imf::Header header(4, 4);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT, 2, 2));
    std::vector<float> values(4, 1.0F);
    {
        Imf::OutputFile file((folder / "a.exr").c_str(), header);
        Imf::FrameBuffer frame;
        frame.insert("Y",
                     Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8, 2, 2));
        file.setFrameBuffer(frame);
        file.writePixels(4);
    }
    expect_error(ErrorCode::InvalidInput, "a.exr: channel 'Y' is subsampled",
                 [&] { read_image(folder / "a.exr"); });
}

// Headers made to claim what the file does not hold: refused before OpenEXR allocates.
TEST(ExrReader, RefusesClaimsBeforeAllocating) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.exr";
    write_exr(path, {{"Y"}}, Imf::ZIP_COMPRESSION, true);
    const std::string good = get(path);
    const auto claim = [&](std::size_t place, std::span<const std::int32_t> numbers,
                           const std::string& why) {
        std::string changed = good;
        std::memcpy(changed.data() + place, numbers.data(), numbers.size_bytes());
        put(path, changed);
        expect_error(ErrorCode::InvalidInput, why, [&] { read_image(path); });
    };
    // "dataWindow\0box2i\0", u32 16, then xMin, yMin, xMax, yMax
    const std::size_t window = good.find("dataWindow") + 11 + 6 + 4;
    claim(window, std::array{0, 0, 32767, 8191}, "32768 x 8192 samples do not fit a file of");
    claim(window, std::array{0, 0, 32768, 0}, "32769 x 1 pixels, 1 to 32768");
    claim(window, std::array{0, 0, 32767, 32767}, "268435456 in all are allowed");
    claim(window, std::array{0, 0, 2147483647, 0}, "2147483648 x 1 pixels");
    claim(window, std::array{0, 0, -1, 0}, "the data window is empty");
    claim(window, std::array{0, 0, 199, 199}, "tiles of 4 x 4 samples do not fit a file of");
    // "tiles\0tiledesc\0", u32 9, then width, height
    const std::size_t tiles = good.find("tiledesc") + 9 + 4;
    claim(tiles, std::array{0, 4}, "tiles of 0 x 4 samples, 1 to 4096");
    claim(tiles, std::array{8192, 4}, "tiles of 8192 x 4 samples, 1 to 4096");
    // "channels\0chlist\0", u32 19, then "Y\0" and 16 bytes, then the end of the list
    const std::size_t list = good.find("chlist") + 7 + 4;
    put(path, std::string(good).replace(list, 1, 1, '\0'));
    expect_error(ErrorCode::InvalidInput, "no channels", [&] { read_image(path); });
    put(path, std::string(good).replace(5, 1, 1, '\x10'));
    expect_error(ErrorCode::InvalidInput, "several parts, a picture is one",
                 [&] { read_image(path); });
    put(path, std::string(good).replace(5, 1, 1, '\x08'));
    expect_error(ErrorCode::InvalidInput, "a deep image is no picture", [&] { read_image(path); });
}

// --- Damaged files of both formats --------------------------------------------------------------

/// Reads what may be damaged: a picture as large as it says, or an error that names the file.
bool read_or_refused(const std::string& path) {
    try {
        const Image image = read_image(path);
        EXPECT_EQ(image.rgb.size(), 3 * static_cast<std::size_t>(image.width) *
                                        static_cast<std::size_t>(image.height));
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
        EXPECT_EQ(error.where().substr(0, path.size()), path);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    return false;
}

/// Every byte set to four values, every cut, and `splices` stretches of noise at random places.
void expect_survives_damage(const std::string& path, std::uint64_t splices) {
    const std::string good = get(path);
    ASSERT_TRUE(read_or_refused(path));
    std::size_t refused = 0, tried = 0;
    const auto look = [&](auto) {
        ++tried;
        refused += read_or_refused(path) ? 0 : 1;
    };
    test::with_each_byte_damaged(path, good.size(), look);
    for (std::uint64_t i = 0; i < splices; ++i) {
        std::string changed = good;
        const auto word = CounterRandom(11, 0).bits(i);
        const std::size_t place = word[0] % good.size(), count = 1 + word[1] % 8;
        for (std::size_t k = place; k < std::min(place + count, good.size()); ++k)
            changed[k] =
                static_cast<char>(CounterRandom(12, static_cast<std::uint32_t>(k)).bits(i)[0]);
        put(path, changed);
        look(i);
    }
    put(path, good);
    test::with_each_cut(path, look);
    EXPECT_GT(tried, 1000u);
    EXPECT_GT(refused, 100u);
}

TEST(DamagedImages, Radiance) {
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

TEST(DamagedImages, OpenExr) {
    const TemporaryFolder folder;
    const std::vector<Channel> channels = {{"R", Imf::HALF}, {"G", Imf::FLOAT}, {"B", Imf::HALF}};
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        write_exr(folder / "a.exr", channels, compression, false);
        expect_survives_damage(folder / "a.exr", 200);
    }
    write_exr(folder / "tiled.exr", channels, Imf::ZIP_COMPRESSION, true);
    expect_survives_damage(folder / "tiled.exr", 200);
}

}  // namespace
}  // namespace asperity::io
