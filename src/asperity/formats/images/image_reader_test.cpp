// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <asperity/formats/images/image_test_damage.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {
namespace {

using namespace std::string_literals;
using test::expect_error;
using test::expect_survives_damage;
using test::get;
using test::put;
using test::TemporaryFolder;

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

TEST(ExrReader, SurvivesDamage) {
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
