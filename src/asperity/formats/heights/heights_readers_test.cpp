// SPDX-License-Identifier: Apache-2.0
// Readers of topographies on files made here.
#include <asperity/formats/heights/heights_format.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/test_files.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace asperity::io {
namespace {

using test::error_of;
using test::expect_error;
using test::put;
using test::TemporaryFolder;

template <typename Number>
std::string little(Number value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

template <typename Number>
std::string big(Number value) {
    std::string bytes = little(value);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

void set(std::string& file, std::size_t at, const std::string& bytes) {
    file.replace(at, bytes.size(), bytes);
}

Topography read_bytes(const std::string& name, const std::string& bytes,
                      const HeightsOptions& options = {}) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    asperity::Run run(1);
    return read_topography(folder / name, options, run);
}

void refuse(const std::string& name, const std::string& bytes, const std::string& why) {
    expect_error(ErrorCode::InvalidInput, why, [&] { read_bytes(name, bytes); });
}

// 3 x 2 heights 1 .. 6 um, the fourth missing where the format has a word for it.
std::string sdf_text() {
    return "aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-6\nYscale = 2e-6\nZscale = "
           "1e-6\nDataType = 7\n*\n1 2 3\nBAD 5 6\n*\n";
}

std::string sdf_binary() {
    std::string file("bISO-1.0");
    file.resize(81);
    set(file, 42, little<std::uint16_t>(3));
    set(file, 44, little<std::uint16_t>(2));
    set(file, 46, little(1e-6) + little(2e-6) + little(1e-6));
    file[79] = 5;
    for (const int n : {1, 2, 3, -32768, 5, 6}) file += little(static_cast<std::int16_t>(n));
    return file;
}

std::string sur(bool compressed) {
    std::string file(512, '\0');
    set(file, 0, compressed ? "DSCOMPRESSED" : "DIGITAL SURF");
    set(file, 14, little<std::int16_t>(1) + little<std::int16_t>(1) + little<std::int16_t>(2));
    set(file, 86, little<std::int16_t>(1));
    set(file, 98, little<std::int16_t>(16) + little(1) + little(6) + little(3) + little(2));
    set(file, 120, little(1e-3f) + little(2e-3f) + little(1.0f));
    set(file, 180, "mm");
    set(file, 196, "mm");
    set(file, 212, "\xb5m");
    std::string data;
    for (const int n : {1, 2, 3, -1, 5, 6}) data += little(static_cast<std::int16_t>(n));
    if (!compressed) return file + data;
    std::string zipped(200, '\0');
    uLongf length = zipped.size();
    compress(reinterpret_cast<Bytef*>(zipped.data()), &length,
             reinterpret_cast<const Bytef*>(data.data()), data.size());
    zipped.resize(length);
    return file + little<std::uint32_t>(1) + little(static_cast<std::uint32_t>(data.size())) +
           little(static_cast<std::uint32_t>(length)) + zipped;
}

std::string metropro() {
    std::string file(834, '\0');
    set(file, 0, "\x88\x1b\x03\x6f");
    set(file, 6, big<std::uint32_t>(834));
    set(file, 68, big<std::uint16_t>(3) + big<std::uint16_t>(2));
    set(file, 164, big(1.0f) + big(4096e-6f));
    set(file, 176, big(1.0f));
    set(file, 184, big(1e-6f));
    for (const int n : {1, 2, 3, 2147483640, 5, 6}) file += big(n);
    return file;
}

std::string tmd() {
    std::string file("Binary TrueMap Data File v2.0\r\n");
    file.resize(32);
    file += std::string("by hand\0", 8) + little<std::uint32_t>(3) + little<std::uint32_t>(2) +
            little(3e-3f) + little(4e-3f) + little(0.0f) + little(0.0f);
    for (int n = 1; n <= 6; ++n) file += little(static_cast<float>(n) * 1e-3f);
    return file;
}

std::string npy() {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(117, ' ');
    header += '\n';
    std::string file = "\x93NUMPY" + std::string("\x01\x00", 2) +
                       little(static_cast<std::uint16_t>(header.size())) + header;
    for (int n = 1; n <= 6; ++n) file += little(static_cast<double>(n));
    return file;
}

void expect_heights(const Topography& t, double scale, double tolerance) {
    ASSERT_EQ(t.nx, 3);
    ASSERT_EQ(t.ny, 2);
    for (std::size_t k = 0; k < 6; ++k) {
        if (!t.missing.empty() && t.missing[k] == 1) continue;
        EXPECT_NEAR(t.heights[k], static_cast<double>(k + 1) * scale, tolerance * scale) << k;
    }
}

TEST(HeightsReaders, ReadWhatInstrumentsWrite) {
    for (const std::string& file : {sdf_text(), sdf_binary(), sur(false), sur(true), metropro()}) {
        const Topography t = read_bytes("a.anything", file);
        expect_heights(t, 1e-6, 1e-6);
        EXPECT_EQ(t.unit, "m");
        EXPECT_NEAR(t.dx, 1e-6, 1e-12);
        EXPECT_EQ(t.missing_count(), 1u);
        EXPECT_EQ(t.missing[3], 1);
    }
    const Topography t = read_bytes("a.b", tmd());
    expect_heights(t, 1e-6, 1e-6);
    EXPECT_NEAR(t.dy, 2e-6, 1e-12);
    expect_heights(read_bytes("a.b", npy()), 1, 0);
}

TEST(HeightsReaders, EverySmallDamageIsRefusedOrRead) {
    const TemporaryFolder folder;
    std::mt19937 engine(15);
    for (const std::string& good :
         {sdf_text(), sdf_binary(), sur(false), sur(true), metropro(), tmd(), npy()}) {
        for (int k = 0; k < 2000; ++k) {
            std::string bad = good;
            for (unsigned n = 0; n <= k % 4u; ++n)
                bad[engine() % bad.size()] = static_cast<char>(engine());
            if (k % 5 == 0) bad.resize(engine() % bad.size());
            put(folder / "a.b", bad);
            asperity::Run run(1);
            const auto error = error_of([&] { read_topography(folder / "a.b", {}, run); });
            if (error) {
                EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
            }
        }
    }
}

TEST(HeightsReaders, MissingPointsAreNotMeasured) {
    const TemporaryFolder folder;
    put(folder / "a.sdf", sdf_text());
    expect_error(ErrorCode::InvalidInput, "1 of 6 points are missing (16.7 %)",
                 [&] { read_heights(folder / "a.sdf"); });
}

TEST(HeightsTexts, HeadersInAnyLanguage) {
    for (const std::string words :
         {"# Channel: Z\n# Width: 3 \xc2\xb5m\n# Height: 4 \xc2\xb5m\n# Value units: nm\n",
          "# Kanal: Z\n# Breite: 3,0 \xc2\xb5m\n# H\xc3\xb6he: 4,0 \xc2\xb5m\n# Werte: nm\n"}) {
        const Topography t = read_bytes("a.txt", words + "1 2 3\n4 5 6\n");
        expect_heights(t, 1e-9, 1e-12);
        EXPECT_DOUBLE_EQ(t.dx, 1e-6);
        EXPECT_DOUBLE_EQ(t.dy, 2e-6);
    }
    const Topography t = read_bytes(
        "a.txt",
        "h=2 w=3\npixel size=1e-006 m\nheight conversion factor (-> m)=1e-9\n1 2 3\n4 5 6\n");
    expect_heights(t, 1e-9, 1e-12);
    EXPECT_DOUBLE_EQ(t.dy, 1e-6);
    refuse("a.txt", "h=3 w=3\n1 2 3\n4 5 6\n", "the header announces 3 x 3 numbers, 3 x 2");
    refuse("a.txt", "# pixel size: 1 um\n1 2 3\n4 5 6\n",
           "--format matrix reads the numbers alone");
}

TEST(HeightsTexts, DecimalCommas) {
    expect_heights(read_bytes("a.txt",
                              "\xef\xbb\xbf"
                              "1,0\t2,0\t3,0\n4,0\t5,0\t6,0\n"),
                   1, 0);
    expect_heights(read_bytes("a.csv", "1,0;2,0;3\r\n4;5;6\r\n"), 1, 0);
    expect_heights(read_bytes("a.csv", "1,2,3\n4,5,6\n"), 1, 0);
    expect_heights(read_bytes("a.csv", "1, 2, 3\n4, 5, 6\n"), 1, 0);
    refuse("a.txt", "1,2,3 4\n", "can be read two ways: --decimal point");
    refuse("a.txt", "1,2 3.5\n", "--decimal comma");
    expect_heights(read_bytes("a.txt", "1,2 3\n4 5,6\n", {"", "", "point"}), 1, 0);
    refuse("a.txt", "1 2 x\n", "'x' is not a number");
}

TEST(HeightsTexts, PointsOnAGrid) {
    // In any order, one missing; the largest y is the top row.
    const Topography t = read_bytes("a.xyz", "2 0 6\n0 2 1\n1 2 2\n2 2 3\n1 0 5\n");
    expect_heights(t, 1, 0);
    EXPECT_EQ(t.missing_count(), 1u);
    EXPECT_EQ(t.missing[3], 1);
    EXPECT_EQ(t.dy, 2);
    std::string cloud;
    for (int k = 0; k < 40; ++k)
        cloud += std::to_string(std::sqrt(k)) + " " + std::to_string(std::sqrt(k * k * k)) + " 1\n";
    refuse("a.txt", cloud, "40 rows of three numbers can be points x y z");
    EXPECT_EQ(read_bytes("a.txt", cloud, {"matrix", "", ""}).ny, 40);
}

TEST(HeightsTexts, GridsWithFixedWords) {
    Topography t = read_bytes("a.asc",
                              "NCOLS 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n"
                              "NODATA_value -9999\n1 2 3\n-9999 5 6\n");
    expect_heights(t, 1, 0);
    EXPECT_EQ(t.dx, 2);
    EXPECT_EQ(t.missing_count(), 1u);
    refuse("a.asc", "ncols 3\nnrows 2\n1 2 3\n4 5 6\n", "no cellsize");
    refuse("a.asc", "ncols 4\nnrows 2\ncellsize 1\n1 2 3\n4 5 6\n", "4 x 2 numbers, 6 are found");
    t = read_bytes("a.asc",
                   "# File Format = ASCII\n# x-pixels = 3\n# y-pixels = 2\n# x-length = 3000\n"
                   "# y-length = 2000\n# Bit2nm = 1000\n1 2 3\n4 5 6\n");
    expect_heights(t, 1e-6, 1e-12);
    EXPECT_DOUBLE_EQ(t.dx, 1e-6);
}

TEST(HeightsFormats, AreOpenAndContentDecides) {
    expect_heights(read_bytes("a.png", npy()), 1, 0);
    expect_error(ErrorCode::Usage, "format: 'none' is none of gsf", [] {
        read_bytes("a.npy", npy(), {"none", "", ""});
    });
    refuse("a.vk4", "VK4_", "read in Python and handed over");
    expect_error(ErrorCode::InvalidInput, "there is no channel '2': 1 'heights'", [] {
        read_bytes("a.npy", npy(), {"", "2", ""});
    });

    HeightsFormats formats;
    HeightsFormat mine;
    mine.name = "mine";
    mine.recognises = [](std::string_view head) { return head.starts_with("MINE"); };
    mine.open = [](const HeightsSource& source) {
        const auto channel = [source](const char* name) {
            return HeightsChannel{
                name, 2, 2, {}, [source] { return empty_topography(2, 2, source.path()); }};
        };
        return std::vector{channel("left"), channel("right")};
    };
    formats.add(mine);
    expect_error(ErrorCode::Usage, "mine: there is a format", [&] { formats.add(mine); });
    const TemporaryFolder folder;
    put(folder / "a.txt", "MINE");
    asperity::Run run(1);
    EXPECT_EQ(formats.read(HeightsSource(folder / "a.txt", {"", "right", ""}, run)).nx, 2);
    expect_error(ErrorCode::InvalidInput, "--channel chooses (1 'left', 2 'right')",
                 [&] { formats.read(HeightsSource(folder / "a.txt", {}, run)); });
}

TEST(HeightsReaders, HearAStop) {
    const TemporaryFolder folder;
    put(folder / "a.npy", npy());
    asperity::Run run(1);
    run.request_stop();
    expect_error(ErrorCode::Stopped, "stopped while reading",
                 [&] { read_topography(folder / "a.npy", {}, run); });
}

}  // namespace
}  // namespace asperity::io
