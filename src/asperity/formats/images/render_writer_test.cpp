// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/images/render_writer.h>
#include <asperity/formats/test_files.h>
#include <png.h>

#include <cstring>
#include <map>

namespace asperity::io {
namespace {

using test::expect_error;
using test::get;
using test::TemporaryFolder;

/// 5 x 3 pixels of 4 samples each.
Film some_film() {
    Film film(5, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x)
            for (int n = 0; n < 4; ++n)
                film.at(x, y).add({0.1 * x + 0.01 * n, 0.2 * y, 0.05 * (x + y + n)});
    return film;
}

const Provenance kProvenance = {{"model", "sphere"},   {"light", "sky"},
                                {"light", "point"},    {"seed", "18446744073709551615"},
                                {"brdf", "größe.asp"}, {"until", ""}};

TEST(Labelled, NamesThatComeAgainAreNumbered) {
    const Provenance labels = labelled(kProvenance);
    ASSERT_EQ(labels.size(), 6u);
    EXPECT_EQ(labels[0], (std::pair<std::string, std::string>("asperity:model", "sphere")));
    EXPECT_EQ(labels[1].first, "asperity:light");
    EXPECT_EQ(labels[2].first, "asperity:light.2");
    EXPECT_EQ(labels[2].second, "point");
}

TEST(RenderExr, KeepsTheFilmAndWhereItComesFrom) {
    const TemporaryFolder folder;
    const Film film = some_film();
    write_render_exr(film, kProvenance, folder / "a.exr");
    const Image image = read_image(folder / "a.exr");
    EXPECT_EQ(image.width, 5);
    EXPECT_EQ(image.height, 3);
    EXPECT_EQ(image.rgb, film.image().rgb);

    Imf::InputFile file((folder / "a.exr").c_str());
    for (const auto& [name, value] : labelled(kProvenance)) {
        const auto* text = file.header().findTypedAttribute<Imf::StringAttribute>(name);
        ASSERT_TRUE(text) << name;
        EXPECT_EQ(text->value(), value);
    }
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(Imf::chromaticities(file.header()).red, Imath::V2f(0.64F, 0.33F));
    std::vector<float> error(15);
    Imf::FrameBuffer frame;
    frame.insert("stderr.Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(error.data()), 4, 20));
    file.setFrameBuffer(frame);
    file.readPixels(0, 2);
    for (std::size_t k = 0; k < 15; ++k)
        EXPECT_EQ(error[k], static_cast<float>(film.pixels()[k].standard_error()));
    EXPECT_GT(error[0], 0);
}

/// The chunks of a PNG by their types, in order.
std::multimap<std::string, std::string> chunks_of(const std::string& png) {
    std::multimap<std::string, std::string> chunks;
    for (std::size_t place = 8; place + 12 <= png.size();) {
        std::size_t size = 0;
        for (std::size_t k = 0; k < 4; ++k)
            size = size << 8 | static_cast<unsigned char>(png[place + k]);
        chunks.emplace(png.substr(place + 4, 4), png.substr(place + 8, size));
        place += size + 12;
    }
    return chunks;
}

TEST(RenderPng, HoldsTheBytesOfTheToneMapping) {
    const TemporaryFolder folder;
    const Film film = some_film();
    for (const Transfer transfer : {Transfer::Srgb, Transfer::Gamma22, Transfer::Linear}) {
        const ToneMapping mapping{0.5, ToneCurve::Aces, transfer};
        write_render_png(film, mapping, kProvenance, folder / "a.png");
        // 8-bit numbers as they stand, without a change of gamma
        const std::string file = get(folder / "a.png");
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_memory(&png, file.data(), file.size()));
        EXPECT_EQ(png.width, 5u);
        EXPECT_EQ(png.height, 3u);
        EXPECT_EQ(png.format & PNG_FORMAT_FLAG_LINEAR, 0u);
        const auto chunks = chunks_of(file);
        EXPECT_EQ(chunks.count("sRGB"), transfer == Transfer::Srgb ? 1u : 0u);
        EXPECT_EQ(chunks.count("gAMA"), transfer == Transfer::Srgb ? 0u : 1u);
        png_image_free(&png);
        if (transfer != Transfer::Srgb) continue;
        png = {};
        png.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_memory(&png, file.data(), file.size()));
        png.format = PNG_FORMAT_RGB;
        std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
        ASSERT_TRUE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr));
        EXPECT_EQ(pixels, to_bytes(mapping, film.image()));
    }
}

// gAMA holds 100000 times the exponent that a viewer's encoding has: 1 / 2.2 is 45455.
TEST(RenderPng, NamesItsTransfer) {
    const TemporaryFolder folder;
    const auto gamma = [&](Transfer transfer) {
        write_render_png(some_film(), {0, ToneCurve::None, transfer}, {}, folder / "a.png");
        const auto chunks = chunks_of(get(folder / "a.png"));
        std::uint32_t value = 0;
        for (const char byte : chunks.find("gAMA")->second)
            value = value << 8 | static_cast<unsigned char>(byte);
        return value;
    };
    EXPECT_EQ(gamma(Transfer::Gamma22), 45455u);
    EXPECT_EQ(gamma(Transfer::Linear), 100000u);
}

TEST(RenderPng, TellsWhereItComesFrom) {
    const TemporaryFolder folder;
    write_render_png(some_film(), {}, kProvenance, folder / "a.png");
    const auto chunks = chunks_of(get(folder / "a.png"));
    std::map<std::string, std::string> texts;
    for (auto [it, end] = chunks.equal_range("tEXt"); it != end; ++it) {
        const std::size_t nul = it->second.find('\0');
        texts[it->second.substr(0, nul)] = it->second.substr(nul + 1);
    }
    EXPECT_EQ(texts["asperity:model"], "sphere");
    EXPECT_EQ(texts["asperity:light"], "sky");
    EXPECT_EQ(texts["asperity:light.2"], "point");
    EXPECT_EQ(texts["asperity:seed"], "18446744073709551615");
    EXPECT_EQ(texts.count("asperity:until"), 1u);
    // Text beyond ASCII: keyword, NUL, uncompressed, method 0, two empty names, UTF-8
    ASSERT_EQ(chunks.count("iTXt"), 1u);
    EXPECT_EQ(chunks.find("iTXt")->second,
              std::string("asperity:brdf\0\0\0\0\0", 18) + "größe.asp");
}

TEST(RenderWriter, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const Film film = some_film();
    for (const std::string& path : {folder / "none/a.exr", folder / "none/a.png"}) {
        const auto write = [&] {
            path.ends_with("exr") ? write_render_exr(film, {}, path)
                                  : write_render_png(film, {}, {}, path);
        };
        expect_error(ErrorCode::InputOutput, "none/a.", write);
    }
    EXPECT_EQ(folder.files(), 0);
    if (!test::has_full_device()) return;
    expect_error(ErrorCode::InputOutput, "/dev/full: cannot write: No space left on device",
                 [&] { write_render_exr(film, {}, "/dev/full"); });
    expect_error(ErrorCode::InputOutput,
                 "/dev/full: ", [&] { write_render_png(film, {}, {}, "/dev/full"); });
}

}  // namespace
}  // namespace asperity::io
