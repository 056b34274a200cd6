// SPDX-License-Identifier: Apache-2.0
// Readers of topographies on files made here.
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/formats/heights/heights_test_files.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/test_files.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io {
namespace {

using test::error_of;
using test::expect_error;
using test::npy;
using test::put;
using test::sdf_text;
using test::TemporaryFolder;

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

void expect_heights(const Topography& t, double scale, double tolerance) {
    ASSERT_EQ(t.nx, 3);
    ASSERT_EQ(t.ny, 2);
    for (std::size_t k = 0; k < 6; ++k) {
        if (!t.missing.empty() && t.missing[k] == 1) continue;
        EXPECT_NEAR(t.heights[k], static_cast<double>(k + 1) * scale, tolerance * scale) << k;
    }
}

TEST(HeightsReaders, ReadWhatInstrumentsWrite) {
    for (const test::HeightsTestFile& file : test::heights_test_files()) {
        SCOPED_TRACE(file.format);
        // Content decides, but for texts that have no words
        const bool bare = file.format == "matrix" || file.format == "xyz";
        const Topography t =
            read_bytes("a.anything", file.bytes, {bare ? file.format : "", "", ""});
        expect_heights(t, file.scale, 1e-6);
        EXPECT_EQ(t.missing_count(), file.missing ? 1u : 0u);
        if (file.missing) {
            EXPECT_EQ(t.missing[3], 1);
        }
        if (file.scale == 1) continue;
        EXPECT_EQ(t.unit, "m");
        EXPECT_NEAR(t.dx, 1e-6, 1e-12);
        // MetroPro knows one spacing
        EXPECT_NEAR(t.dy, file.format == "metropro" ? 1e-6 : 2e-6, 1e-12);
        EXPECT_NE(t.found, "");
    }
}

TEST(HeightsReaders, EveryFormatHasATestFile) {
    const auto files = test::heights_test_files();
    const HeightsFormats formats;
    for (const HeightsFormat& row : formats.rows())
        EXPECT_TRUE(row.write ||
                    std::any_of(files.begin(), files.end(),
                                [&](const auto& file) { return file.format == row.name; }) ||
                    row.name == "png")
            << row.name;
}

TEST(HeightsReaders, RefuseWhatDoesNotFit) {
    using namespace test;
    const auto with = [](std::string file, const std::string& old, const std::string& fresh) {
        const std::size_t at = file.find(old);
        EXPECT_NE(at, std::string::npos) << old;
        return file.replace(at, old.size(), fresh);
    };
    const auto main = [](const std::string& data) {
        return zip({{"main.xml", x3p_document(data)}});
    };
    const auto bad_x3p = [&](const std::string& old, const std::string& fresh) {
        return zip({{"main.xml", with(x3p_document("<DataList/>"), old, fresh)}});
    };
    const auto index = [&](const std::string& xml) {
        return zip({{"index.xml", xml}, {"LAYER_0.raw", six_floats(kGone)}});
    };
    const std::string layer = "<LAYER_0><FILENAME_Z>LAYER_0.raw</FILENAME_Z></LAYER_0></INDEX>";
    const struct {
        const char* name;
        std::string bytes, why;
    } cases[] = {
        {"a.x3p", "PK\x03\x04", "a.x3p: "},
        {"a.x3p", zip({}), "a.x3p: "},
        {"a.x3p", zip({{"other.xml", ""}, {"x/bindata/", ""}}), "the archive holds no main.xml"},
        {"a.x3p", zip({{"main.xml", "<a><b></a>"}}), "main.xml at byte"},
        {"a.x3p", zip({{"main.xml", "<html></html>"}}), "the root 'html', not ISO5436_2"},
        {"a.x3p", main(""), "neither a DataList nor a PointDataLink"},
        {"a.x3p", main("<DataList><Datum>1</Datum></DataList>"), "6 points are announced, 1"},
        {"a.x3p", main("<DataList><Datum>1;2</Datum></DataList>"), "datum 1 has 2 numbers, not 1"},
        {"a.x3p", main("<DataList><Datum>x</Datum></DataList>"), "datum 1: 'x' is not a number"},
        {"a.x3p", main("<DataLink><PointDataLink>a.bin</PointDataLink></DataLink>"),
         "'a.bin' is missing in the archive"},
        {"a.x3p", bad_x3p("SUR", "XYZ"), "the feature type 'XYZ'"},
        {"a.x3p", bad_x3p("<AxisType>A", "<AxisType>I"), "the axis CZ must be absolute"},
        {"a.x3p", bad_x3p("<CX>", "<CW>"), "a.x3p: "},
        {"a.x3p", bad_x3p("1e-006", "wide"), "axis CX: Increment 'wide' is not a number"},
        {"a.x3p", bad_x3p("<SizeX>3", "<SizeX>-3"), "SizeX '-3' is no number of points"},
        {"a.x3p", bad_x3p("<SizeX>3", "<SizeX>400000"), "400000 x 2 samples"},
        {"a.x3p", bad_x3p("<SizeZ>1", "<SizeZ>2"), "2 layers, one is read"},
        {"a.plux", index("<INDEX><GENERAL/>" + layer), "IMAGE_SIZE_X '' is no positive number"},
        {"a.plux",
         index("<INDEX><GENERAL><IMAGE_SIZE_X>4</IMAGE_SIZE_X><IMAGE_SIZE_Y>2</IMAGE_SIZE_Y>"
               "<FOV_X>1</FOV_X><FOV_Y>1</FOV_Y></GENERAL>" +
               layer),
         "holds 24 bytes, 4 x 2 samples need 32"},
        {"a.plux", index("<INDEX><GENERAL>"), "index.xml at byte"},
        {"a.gwy", with(gwy(), "GwyContainer", "GwyCuntainer"), "no GwyContainer"},
        {"a.gwy", with(gwy(), "xres", "xrez"), "0 x 2 is no size of a field"},
        {"a.gwy", with(gwy(), "data" + std::string("\0D", 2), "dada" + std::string("\0D", 2)),
         "a data field has no data"},
        {"a.gwy", with(gwy(), std::string("xres\0i\x03", 7), std::string("xres\0i\x04", 7)),
         "4 x 2 samples are announced, 6 are there"},
        {"a.gwy", with(gwy(), std::string("si_unit_z\0o", 11), std::string("si_unit_q\0o", 11)),
         "need units of length both"},
        {"a.gwy", gwy().substr(0, 90), "a.gwy: "},
        {"a.opd", with(opd(), "Wavelength", "Wovelength"), "the wavelength is missing"},
        {"a.opd", with(opd(), "RAW DATA", "SAW DATA"), "no channel holds heights"},
        {"a.opd", opd().substr(0, opd().size() - 30), "a.opd: "},
        {"a.opd", with(opd(), std::string("\x90\0\0\0", 4), std::string("\x91\0\0\0", 4)),
         "a directory of 145 bytes is no multiple of 24"},
        {"a.plu", plu().substr(0, plu().size() - 20), "a.plu: "},
        {"a.plu", plu().replace(428, 1, "\x01"), "of type 1 is no topography"},
        {"a.al3d", with(al3d(), "Cols", "Colz"), "the tag Cols is missing"},
        {"a.al3d", with(al3d(), "TagCount", "TogCount"), "the tag TagCount is missing"},
        {"a.al3d", with(al3d(), "\r\nCols", "\r\rCols"), "does not end with a line end"},
        {"a.al3d", al3d().substr(0, al3d().size() - 9), "a.al3d: "},
        {"a.tif", tiff().substr(0, 40), "a.tif: "},
        {"a.tif",
         with(tiff(), std::string("\x02\x01\x03\0\x01\0\0\0\x20", 9),
              std::string("\x02\x01\x03\0\x01\0\0\0\x08", 9)),
         "heights need 16-bit or 32-bit float samples, not 8 bits"},
        {"a.tif",
         with(tiff(), std::string("\0\x01\x04\0\x01\0\0\0\x03", 9),
              std::string("\0\x01\x04\0\x01\0\0\0\xff", 9)),
         "a.tif: "},
        {"a.sdf", sdf_binary().substr(0, 90), "a.sdf: "},
        {"a.sdf", with(sdf_text(), "NumPoints = 3", "NumPoints = x"), "a.sdf"},
        {"a.sur", sur(false).substr(0, 520), "a.sur: "},
        {"a.sur", sur(true).substr(0, 526), "a.sur: "},
        {"a.dat", metropro().substr(0, 850), "a.dat: "},
        {"a.tmd", tmd().substr(0, 70), "a.tmd: "},
        {"a.npy", npy().substr(0, 150), "a.npy: "},
        {"a.bcr", bcr_integers().substr(0, 2058), "12 x 1 bytes are needed from byte 2048"},
        {"a.bcr", with(bcr_integers(), "xpixels = 3", "xpixels = x"), "xpixels 'x' is no whole"},
        {"a.bcr", with(bcr_integers(), "xpixels = 3", "xpixels = 1"), "1 x 2 samples"},
        {"a.bcr", with(bcr_integers(), "bcrstm", "bcrxyz"), "is neither bcrstm nor bcrf"},
        {"a.bcr", with(bcr_integers(), "bit2nm = 2", "bit2nm = 0"), "a count is no length"},
        {"a.bcr", with(bcr_integers(), "# by hand\n", "zunit = V\n"), "no channel holds heights"},
        {"a.bcr", with(bcr_integers(), "# by hand\n", "xunit = V\n"), "'V' is no unit of length"},
        {"a.bcr", with(bcr_integers(), "xlength = 3000", "xlength = -100"),
         "is no positive length"},
        {"a.bcr", with(bcr_integers(), "# by hand\n", "headersize = 999999999999\n"),
         "the file ends at 2076"},
        {"a.mnt", mnt().substr(0, 600), "a.mnt: "},
        {"a.mnt", mnt().substr(0, 2000), "lies behind the end of the file"},
        {"a.mnt", mnt().replace(30, 1, "\x0a"), "sectors of 2^10 bytes"},
        {"a.mnt", mnt().replace(512 + 8, 4, bytes_of(2)), "runs in a circle"},
        {"a.mnt", compound_file("Other", std::string(4096, 'x')), "has no stream ScopedContents"},
        {"a.mnt", compound_file("ScopedContents", "short"), "of 5 bytes is too short"},
        {"a.mnt", compound_file("ScopedContents", std::string(4096, 'x')), "no channel holds"},
        {"a.mnt", with(mnt(), bytes_of(9062), bytes_of(9063)), "no channel holds heights"},
        {"a.mnt", with(mnt(), entry(1, bytes_of(3)), entry(1, bytes_of(4))),
         "24 bytes are no 4 x 2 heights"},
        {"a.mnt",
         with(mnt(), bytes_of(std::uint64_t{20}) + bytes_of(std::uint64_t{0}),
              bytes_of(std::uint64_t{19}) + bytes_of(std::uint64_t{0})),
         "a block of 20 bytes does not fit"},
        {"a.nms", nms().substr(0, 3470), "a.nms: "},
        {"a.nms", nms().substr(0, 100), "a.nms: "},
        {"a.nms", nms().replace(16, 8, nms().substr(24, 8)), "are no range"},
        {"a.tif", park_tiff().substr(0, 420), "a.tif: "},
        {"a.tif", with(park_tiff(), wide_letters("nm"), wide_letters("V ")),
         "no channel holds heights"},
        {"a.tif", park_tiff().replace(12, 1, "\x01"), "a line profile"},
        {"a.tif", park_tiff().replace(12 + 100, 1, "\x04"),
         "4 x 2 samples need 32 bytes, the tag 50434 holds 24"},
        {"a.tif", park_tiff().replace(12 + 348, 1, "\x03"), "samples of type 3 are not known"},
        {"a.tif", park_tiff().replace(12 + 220, 8, std::string(8, '\0')),
         "give no height of a count"},
        {"a.spm", nanoscope().substr(0, 2055), "a.spm: "},
        {"a.spm", with(nanoscope(), "File list end", "Fale list end"), "has no \\*File list end"},
        {"a.spm", with(nanoscope(), "Samps/line: 3", "Samps/line: x"), "'x' is no whole number"},
        {"a.spm", with(nanoscope(), "Bytes/pixel: 2", "Bytes/pixel: 3"), "samples of 3 bytes"},
        {"a.spm", with(nanoscope(), "32.768 um/V", "32.768 um/A"), "no channel holds heights"},
        {"a.spm", with(nanoscope(), "Scan Size: 3 4 ~m", "Scan Sighs: 3 4 ~m"), "the scan size"},
        {"a.spm", with(nanoscope(), "Scan Size: 3 4 ~m", "Scan Size: 3 4 ~V"),
         "no positive length"},
        {"a.npy", with(npy(), "<f8", "<c8"), "a.npy: "},
    };
    for (const auto& bad : cases) {
        SCOPED_TRACE(std::string(bad.name) + ": " + bad.why);
        refuse(bad.name, bad.bytes, bad.why);
    }
}

TEST(HeightsReaders, MissingPointsAreNotMeasured) {
    const TemporaryFolder folder;
    put(folder / "a.sdf", sdf_text());
    expect_error(ErrorCode::InvalidInput, "1 of 6 points are missing (16.7 %), more than the 5 %",
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
    // In any order, one missing; y grows with the row, as the surface has it.
    const Topography t = read_bytes("a.xyz", "2 2 6\n0 0 1\n1 0 2\n2 0 3\n1 2 5\n");
    expect_heights(t, 1, 0);
    EXPECT_EQ(t.missing_count(), 1u);
    EXPECT_EQ(t.missing[3], 1);
    EXPECT_EQ(t.dy, 2);
    expect_error(ErrorCode::InvalidInput, "lie on no regular grid", [] {
        read_bytes("a.txt", "0 2 1\nnan 2 2\n2 2 3\n1 0 5\n2 0 6\n", {"xyz", "", ""});
    });
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

TEST(HeightsReaders, RawBytesOfHeadersAreNotPassedOn) {
    const Topography t = read_bytes("a.txt",
                                    "# H\xf6he: 4 \xb5m\n# Breite: 3 \xb5m\n# Werte: \xb5m\n# von "
                                    "\x1b[31mrot: 7\n1 2 3\n4 5 6\n");
    EXPECT_EQ(t.unit, "m");
    for (const std::string& text : {t.found, t.assumed, t.name})
        EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) {
            return c >= ' ' && c < '\x7f';
        })) << text;
    std::string file = test::gwy();
    file.replace(file.find("Height"), 6,
                 "H\xf6"
                 "he\x1b\x9b");
    asperity::Run run(1);
    const TemporaryFolder folder;
    put(folder / "a.gwy", file);
    EXPECT_EQ(HeightsFormats().list(HeightsSource(folder / "a.gwy", {}, run))[0].name, "H?he??");
}

TEST(HeightsTexts, HeaderLinesThatAreNotUsedAreNamed) {
    const Topography t =
        read_bytes("a.txt", "# taken on a Monday\n# by hand\n# objective 50x\n1 2 3\n4 5 6\n");
    EXPECT_NE(t.assumed.find("header line 1 is not used: 'taken on a Monday'"), std::string::npos)
        << t.assumed;
    EXPECT_NE(t.assumed.find("1 more header lines are not used"), std::string::npos) << t.assumed;
}

/// A small file of each format that is read: instruments' and those we write.
std::vector<std::pair<std::string, std::string>> a_file_of_each_format() {
    std::vector<std::pair<std::string, std::string>> files;
    for (const test::HeightsTestFile& file : test::heights_test_files())
        files.emplace_back(file.format, file.bytes);
    const Heightfield surface = empty_patch(3, 2, "made here");
    const TemporaryFolder folder;
    const HeightsFormats formats;
    for (const HeightsFormat& format : formats.rows()) {
        if (!format.write) continue;
        format.write(surface, folder / "a");
        files.emplace_back(format.name, test::get(folder / "a"));
    }
    return files;
}

TEST(HeightsReaders, EachTellsItsProgressAndHearsAStop) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.anything";
    for (const auto& [format, bytes] : a_file_of_each_format()) {
        SCOPED_TRACE(format);
        put(path, bytes);
        const HeightsOptions options{format, "", ""};
        asperity::Run run(1);
        read_topography(path, options, run);
        const Progress told = run.progress();
        EXPECT_EQ(told.stage, "reading heights");
        EXPECT_GE(told.total, 2u);
        EXPECT_EQ(told.done, told.total);

        asperity::Run stopped(1);
        stopped.request_stop();
        expect_error(ErrorCode::Stopped, "stopped while reading",
                     [&] { read_topography(path, options, stopped); });
    }
}

}  // namespace
}  // namespace asperity::io
