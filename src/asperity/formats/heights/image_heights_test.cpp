// SPDX-License-Identifier: Apache-2.0
// Pictures as heights: files made with the libraries themselves.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/test_files.h>
#include <half.h>
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {
namespace {

using test::error_of;
using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

// Rows of big-endian bytes, as they stand in the file.
void write_png(const std::string& path, int width, int height, int depth, int colour,
               const std::string& bytes, int interlace = PNG_INTERLACE_NONE) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 depth, colour, interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    std::vector<png_bytep> rows;
    std::vector<png_byte> copy(bytes.begin(), bytes.end());
    for (int j = 0; j < height; ++j)
        rows.push_back(copy.data() + copy.size() / static_cast<std::size_t>(height) *
                                         static_cast<std::size_t>(j));
    png_set_interlace_handling(png);
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

// 3 x 2 values 0, 1, 256, 65535, 32768, 2.
std::string sixteen_bits() {
    return {"\x00\x00\x00\x01\x01\x00\xff\xff\x80\x00\x00\x02", 12};
}

const std::vector<float> kSixteen = {0.0f / 65535, 1.0f / 65535,     256.0f / 65535,
                                     1.0f,         32768.0f / 65535, 2.0f / 65535};

TEST(PngHeights, SixteenBits) {
    const TemporaryFolder folder;
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
        write_png(folder / "a.png", 3, 2, 16, PNG_COLOR_TYPE_GRAY, sixteen_bits(), interlace);
        const Heightfield s = read_heights(folder / "a.png");
        EXPECT_EQ(s.nx, 3);
        EXPECT_EQ(s.ny, 2);
        for (std::size_t k = 0; k < kSixteen.size(); ++k)
            EXPECT_FLOAT_EQ(s.heights[k], kSixteen[k]) << k;
    }
}

TEST(PngHeights, EightBits) {
    const TemporaryFolder folder;
    write_png(folder / "a.png", 2, 2, 8, PNG_COLOR_TYPE_GRAY, std::string("\x00\x33\x66\xff", 4));
    const Heightfield s = read_heights(folder / "a.png");
    EXPECT_FLOAT_EQ(s.heights[1], 0.2f);
    EXPECT_FLOAT_EQ(s.heights[2], 0.4f);
    EXPECT_EQ(s.heights[3], 1.0f);
}

TEST(PngHeights, ColoursThatAreAlikeCountAsOne) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.png";
    write_png(path, 2, 2, 8, PNG_COLOR_TYPE_RGB,
              "\x33\x33\x33\x66\x66\x66\xcc\xcc\xcc\xff\xff\xff");
    EXPECT_FLOAT_EQ(read_heights(path).heights[1], 0.4f);
    const std::string alike("\x80\x01\x80\x01\x80\x01\xff\xff", 8);
    write_png(path, 2, 2, 16, PNG_COLOR_TYPE_RGB_ALPHA, alike + alike + alike + alike);
    EXPECT_FLOAT_EQ(read_heights(path).heights[3], 32769.0f / 65535);
    write_png(path, 2, 2, 8, PNG_COLOR_TYPE_RGB,
              "\x33\x33\x33\x66\x66\x67\xcc\xcc\xcc\xff\xff\xff");
    expect_error(ErrorCode::InvalidInput, "the colours differ at sample 1, heights need one",
                 [&] { read_heights(path); });
    write_png(path, 2, 2, 16, PNG_COLOR_TYPE_RGB_ALPHA,
              alike + alike + alike.substr(0, 6) + "\x7f\x7f" + alike);
    expect_error(ErrorCode::InvalidInput, "an alpha that is not full at sample 2",
                 [&] { read_heights(path); });
}

TEST(PngHeights, RefusesOtherPictures) {
    const TemporaryFolder folder;
    const auto refused = [&](int width, int height, int depth, int colour, std::size_t bytes,
                             const std::string& why) {
        write_png(folder / "a.png", width, height, depth, colour, std::string(bytes, '\1'));
        expect_error(ErrorCode::InvalidInput, "a.png: " + why,
                     [&] { read_heights(folder / "a.png"); });
    };
    refused(2, 2, 16, PNG_COLOR_TYPE_GRAY_ALPHA, 16, "heights need a grey PNG");
    refused(8, 2, 4, PNG_COLOR_TYPE_GRAY, 8, "heights need 8 or 16 bits, not 4");
    refused(1, 2, 8, PNG_COLOR_TYPE_GRAY, 2, "1 x 2 samples, 2 to 32768");
    put(folder / "a.png", "");
    expect_error(ErrorCode::InvalidInput, "a.png: PNG: the file ends early",
                 [&] { read_heights(folder / "a.png"); });
    put(folder / "a.png", "This is text and no picture");
    expect_error(ErrorCode::InvalidInput, "a.png: PNG: Not a PNG file",
                 [&] { read_heights(folder / "a.png"); });
}

// A header that claims 32768 x 32768 samples with a right check sum, over the data of six.
TEST(PngHeights, RefusesABombBeforeAllocating) {
    const TemporaryFolder folder;
    write_png(folder / "a.png", 3, 2, 16, PNG_COLOR_TYPE_GRAY, sixteen_bits());
    std::string bytes = get(folder / "a.png");
    bytes.replace(16, 8, std::string("\x00\x00\x80\x00\x00\x00\x80\x00", 8));
    // The CRC of the chunk covers its type and data, bytes 12 .. 28.
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t k = 12; k < 29; ++k) {
        crc ^= static_cast<unsigned char>(bytes[k]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
    }
    crc = ~crc;
    for (std::size_t k = 0; k < 4; ++k)
        bytes[29 + k] = static_cast<char>((crc >> (24 - 8 * k)) & 0xff);
    put(folder / "a.png", bytes);
    expect_error(ErrorCode::InvalidInput, "a.png: 32768 x 32768 samples do not fit a file of",
                 [&] { read_heights(folder / "a.png"); });
}

TEST(PngHeights, CutAndDamagedFilesNeverCrash) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.png";
    write_png(path, 3, 2, 16, PNG_COLOR_TYPE_GRAY, sixteen_bits());
    test::with_each_byte_damaged(path, 1000, [&](std::size_t) {
        const auto error = error_of([&] { validate(read_heights(path), path); });
        EXPECT_TRUE(!error || error->code() == ErrorCode::InvalidInput) << error->what();
    });
    test::with_each_cut(path, [&](std::uintmax_t) {
        expect_error(ErrorCode::InvalidInput, "a.png: ", [&] { read_heights(path); });
    });
}

Imf::Header exr_header(const std::vector<std::pair<std::string, Imf::PixelType>>& channels) {
    // A data window that does not begin at 0.
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({-1, 5}, {1, 6}));
    for (const auto& [name, type] : channels) header.channels().insert(name, Imf::Channel(type));
    return header;
}

void write_exr(const std::string& path,
               const std::vector<std::pair<std::string, Imf::PixelType>>& channels,
               float last = -5) {
    const std::vector<half> halves = {0.5f, 1.0f, 2.0f, 3.0f, 4.0f, -5.0f};
    std::vector<float> floats(halves.begin(), halves.end());
    floats.back() = last;
    const std::vector<unsigned> integers(6, 1u);
    const Imf::Header header = exr_header(channels);
    Imf::FrameBuffer frame;
    for (const auto& [name, type] : channels) {
        const void* data = type == Imf::HALF    ? static_cast<const void*>(halves.data())
                           : type == Imf::FLOAT ? static_cast<const void*>(floats.data())
                                                : static_cast<const void*>(integers.data());
        const std::size_t bytes = type == Imf::HALF ? 2 : 4;
        frame.insert(name, Imf::Slice::Make(type, data, header.dataWindow(), bytes, 3 * bytes));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
}

TEST(ExrHeights, HalfFloatAndAnyDataWindow) {
    const TemporaryFolder folder;
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
        write_exr(folder / "a.exr", {{"height", type}});
        const Heightfield s = read_heights(folder / "a.exr");
        EXPECT_EQ(s.nx, 3);
        EXPECT_EQ(s.ny, 2);
        EXPECT_EQ(s.heights, (std::vector<float>{0.5f, 1, 2, 3, 4, -5}));
    }
}

TEST(ExrHeights, ColoursThatAreAlikeCountAsOne) {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::FLOAT}});
    EXPECT_EQ(read_heights(folder / "a.exr").heights, (std::vector<float>{0.5f, 1, 2, 3, 4, -5}));
}

TEST(ExrHeights, Tiles) {
    const TemporaryFolder folder;
    Imf::Header header(5, 4);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
    std::vector<float> values;
    for (int k = 0; k < 20; ++k) values.push_back(static_cast<float>(k));
    {
        Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
        Imf::FrameBuffer frame;
        frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 20));
        file.setFrameBuffer(frame);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    EXPECT_EQ(read_heights(folder / "a.exr").heights, values);
}

TEST(ExrHeights, RefusesOtherImages) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& why) {
        expect_error(ErrorCode::InvalidInput, "a.exr: " + why,
                     [&] { read_heights(folder / "a.exr"); });
    };
    write_exr(folder / "a.exr", {{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::FLOAT}}, 7);
    refused("the colours differ at sample 5, heights need one");
    write_exr(folder / "a.exr", {{"R", Imf::HALF}, {"G", Imf::HALF}});
    refused("2 channels (G, R), heights need one");
    write_exr(folder / "a.exr", {{"id", Imf::UINT}});
    refused("channel 'id' holds integers");
    put(folder / "a.exr", "");
    refused("offset 0: not an OpenEXR file (wrong magic)");
    put(folder / "a.exr", "v");
    refused("offset 0: not an OpenEXR file (wrong magic)");
    put(folder / "a.exr", "\x76\x2f\x31\x01");
    refused("offset 4: the file ends inside the header");
}

// Headers of a small image made to claim what it does not have: refused before OpenEXR, which
// believes them, sees the file.
TEST(ExrHeights, RefusesClaimsBeforeAllocating) {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", {{"Y", Imf::FLOAT}});
    const std::string good = get(folder / "a.exr");
    const auto claim = [&](std::size_t place, const std::string& bytes, const std::string& why) {
        put(folder / "a.exr", std::string(good).replace(place, bytes.size(), bytes));
        expect_error(ErrorCode::InvalidInput, why, [&] { read_heights(folder / "a.exr"); });
    };
    // "dataWindow\0box2i\0", u32 size 16, then xMin, yMin, xMax, yMax.
    const std::size_t size = good.find("dataWindow") + 11 + 6, box = size + 4;
    const auto window = [](std::int32_t right, std::int32_t bottom) {
        const std::int32_t corners[4] = {0, 0, right, bottom};
        return std::string(reinterpret_cast<const char*>(corners), sizeof corners);
    };
    claim(box, window(32767, 32767), "32768 x 32768 samples do not fit a file of");
    claim(box, window(32768, 1), "a.exr: 32769 x 2 samples, 2 to 32768");
    claim(box, window(2147483647, 1), "a.exr: 2147483648 x 2 samples, 2 to 32768");
    claim(box, window(-1, 1), "the data window is empty");
    claim(box, window(0, 5), "a.exr: 1 x 6 samples, 2 to 32768");
    claim(size, "\xff\xff\xff\x7f", "attribute 'dataWindow' claims 2147483647 bytes, the header");
    claim(size, "\xff\xff\xff\xff", "attribute 'dataWindow' claims 4294967295 bytes, the header");
    claim(size, "\x0f", "the data window does not have 16 bytes");
    claim(5, "\x10", "offset 4: several parts, heights need one");
    claim(5, "\x08", "offset 4: a deep image holds no heights");
}

}  // namespace
}  // namespace asperity::io
