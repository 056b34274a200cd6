// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/surface_files.h>

#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/test_files.h>
#include <asperity/surface/tile_heights.h>
#include <sys/stat.h>

#include <cstring>
#include <random>
#include <tuple>

namespace asperity::io {
namespace {

using namespace std::string_literals;
using test::error_of;
using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

Heightfield random_surface(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<float> normal(0, 1e-7f);
    Heightfield s;
    s.nx = 2 + static_cast<int>(engine() % 9);
    s.ny = 2 + static_cast<int>(engine() % 9);
    // Sizes whose nx-fold, divided by nx again, are not the same number.
    s.dx = 0.1 + 1e-3 * static_cast<double>(engine() % 100), s.dy = s.dx / 3;
    for (int k = 0; k < s.nx * s.ny; ++k) s.heights.push_back(normal(engine));
    s.diagonal = engine() % 2 == 0 ? Diagonal::Anti : Diagonal::Main;
    s.boundary = engine() % 2 == 0 ? Boundary::Periodic : Boundary::Finite;
    s.isotropic = engine() % 2 == 0;
    s.unit = engine() % 2 == 0 ? "m" : "cell";
    s.name = "gaussian surface = 3";
    return s;
}

auto fields(const Heightfield& s) {
    return std::tie(s.nx, s.ny, s.dx, s.dy, s.heights, s.diagonal, s.boundary, s.isotropic, s.unit,
                    s.name);
}

SurfaceSettings settings_for(const std::string& path) {
    SurfaceSettings settings;
    settings.kind = kSurfaceFile;
    settings.file = path;
    return settings;
}

Heightfield load(const SurfaceSettings& settings) {
    Run run(1);
    return load_surface(settings, run);
}

std::string floats(std::initializer_list<float> values) {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

// A minimal field written by hand: 26 + 9 + 9 = 44 bytes of header, so four NULs follow.
std::string small_gsf() {
    return "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\n"s + "\0\0\0\0"s +
           floats({1, 2, 3, 4, 5, 6});
}

void refuse(const std::string& name, const std::string& bytes, const std::string& why) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    expect_error(ErrorCode::InvalidInput, name + why, [&] { read_heights(folder / name); });
}

TEST(Gsf, ReadsAFieldWrittenByHand) {
    const TemporaryFolder folder;
    put(folder / "a.gsf", small_gsf());
    const Heightfield s = read_heights(folder / "a.gsf");
    EXPECT_EQ(s.nx, 3);
    EXPECT_EQ(s.ny, 2);
    EXPECT_EQ(s.heights, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    // A size that is not given is 1.
    EXPECT_EQ(s.dx, 1.0 / 3);
    EXPECT_EQ(s.dy, 1.0 / 2);
    EXPECT_EQ(s.unit, "cell");
    EXPECT_EQ(s.boundary, Boundary::Finite);
    EXPECT_EQ(s.name, folder / "a.gsf");
}

TEST(Gsf, OneToFourNulsAlignTheSamples) {
    const TemporaryFolder folder;
    const std::string header = "Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 2\n";
    ASSERT_EQ(header.size() % 4, 0u);
    for (const std::size_t extra : {0u, 1u, 2u, 3u}) {
        // "T=" and a line end take 3 bytes; `fill` brings the header to 4 n + extra.
        const std::string fill = "T=" + std::string(extra + 1, 'x') + "\n";
        ASSERT_EQ((header + fill).size() % 4, extra);
        const std::string nuls(4 - extra, '\0');
        put(folder / "a.gsf", header + fill + nuls + floats({1, 2, 3, 4}));
        EXPECT_EQ(read_heights(folder / "a.gsf").heights, (std::vector<float>{1, 2, 3, 4}));
        put(folder / "a.gsf", header + fill + nuls.substr(1) + floats({1, 2, 3, 4}));
        expect_error(ErrorCode::InvalidInput, "a.gsf: ", [&] { read_heights(folder / "a.gsf"); });
        put(folder / "a.gsf", header + fill + nuls + "\0"s + floats({1, 2, 3, 4}));
        expect_error(ErrorCode::InvalidInput, "a.gsf: 2 x 2 samples need",
                     [&] { read_heights(folder / "a.gsf"); });
    }
}

TEST(Gsf, WritesTheExactHeader) {
    const TemporaryFolder folder;
    Heightfield s;
    s.nx = 2, s.ny = 3, s.dx = 0.5, s.dy = 2, s.heights = {1, 2, 3, 4, 5, 6};
    s.unit = "m", s.name = "two\nlines";
    write_heights(s, folder / "a.gsf");
    const std::string header =
        "Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 3\nXReal = 1\nYReal = 6\nXYUnits = m\n"
        "ZUnits = m\nTitle = two lines\nAsperityDiagonal = anti\nAsperityBoundary = periodic\n"
        "AsperityIsotropic = false\nAsperityCellX = 0.5\nAsperityCellY = 2\n";
    EXPECT_EQ(get(folder / "a.gsf"),
              header + std::string(4 - header.size() % 4, '\0') + floats({1, 2, 3, 4, 5, 6}));
}

TEST(Gsf, RoundTripsToTheVerySameSurface) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 100; ++seed) {
        const Heightfield s = random_surface(seed);
        write_heights(s, folder / "a.gsf");
        EXPECT_TRUE(fields(read_heights(folder / "a.gsf")) == fields(s)) << seed;
        if (s.boundary == Boundary::Periodic) {
            EXPECT_TRUE(fields(load(settings_for(folder / "a.gsf"))) == fields(s)) << seed;
        }
    }
}

// Gwyddion's field in metres is levelled; what we write of it says so and is read back as it is.
TEST(Gsf, AMeasurementIsLevelledOnce) {
    const TemporaryFolder folder;
    std::string text = "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\nXYUnits = m\nZUnits = m\n";
    text.append(4 - text.size() % 4, '\0');
    put(folder / "a.gsf", text + floats({1, 2.5f, 3, 1, 2.5f, 3}));
    SurfaceSettings settings = settings_for(folder / "a.gsf");
    settings.tiling = Tiling::Finite;
    const Heightfield level = load(settings);
    EXPECT_EQ(level.prepared.find("the mean plane taken off, a tilt of "), 0u) << level.prepared;
    EXPECT_NEAR(level.heights[1], 1.0 / 3, 1e-7);
    write_heights(level, folder / "b.gsf");
    settings.file = folder / "b.gsf";
    const Heightfield back = load(settings);
    EXPECT_EQ(back.heights, level.heights);
    EXPECT_EQ(back.prepared, level.prepared);
    EXPECT_NE(back.source.find("from the header; as Asperity wrote it"), std::string::npos)
        << back.source;
}

TEST(Gsf, Units) {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& lines) {
        std::string text = "Gwyddion Simple Field 1.0\nXRes = 2\nYRes=2\nXReal = 3\n" + lines;
        text.append(4 - text.size() % 4, '\0');
        put(folder / "a.gsf", text + floats({1, 2, 3, 4}));
        return read_heights(folder / "a.gsf");
    };
    const Heightfield s = with("XYUnits = um\nZUnits = nm\n");
    EXPECT_EQ(s.unit, "m");
    EXPECT_DOUBLE_EQ(s.dx, 1.5e-6);
    asperity::Run run(1);
    EXPECT_DOUBLE_EQ(read_topography(folder / "a.gsf", {}, run).heights[3],
                     static_cast<double>(4e-9f));
    EXPECT_EQ(with("XYUnits =\n").unit, "cell");
    expect_error(ErrorCode::InvalidInput, "a.gsf:5: ZUnits 'V' is no unit of length",
                 [&] { with("ZUnits = V\nXYUnits = m\n"); });
    expect_error(ErrorCode::InvalidInput, "a.gsf: only one of XYUnits and ZUnits",
                 [&] { with("XYUnits = m\n"); });
    // A cell size of ours that others have made wrong is not believed.
    EXPECT_EQ(with("AsperityCellX = 7\n").dx, 1.5);
}

TEST(Gsf, RefusesBadFields) {
    const auto field = [](const std::string& lines) {
        std::string text = "Gwyddion Simple Field 1.0\n" + lines;
        text.append(4 - text.size() % 4, '\0');
        return text + floats({1, 2, 3, 4});
    };
    refuse("a.gsf", "", ": not a GSF file (wrong magic)");
    refuse("a.gsf", "G", ": not a GSF file (wrong magic)");
    refuse("a.gsf", "Gwyddion Simple Field 2.0\n", ": not a GSF file");
    refuse("a.gsf", "Gwyddion Simple Field 1.0\n", ": the GSF header is not ended");
    refuse("a.gsf", field(""), ": XRes is missing");
    refuse("a.gsf", field("XRes = 2\n"), ": YRes is missing");
    refuse("a.gsf", field("XRes = 2\nXRes = 2\nYRes = 2\n"), ":3: 'XRes' is given twice");
    refuse("a.gsf", field("XRes = 2\nYRes\n"), ":3: 'YRes' is no 'key = value'");
    refuse("a.gsf", field("XRes = 2\nYRes = 2"), ":3: the header does not end with a line end");
    for (const std::string bad : {"-2", "0", "2.0", "nan", "", "18446744073709551616", "2 2"})
        refuse("a.gsf", field("XRes = 2\nYRes = " + bad + "\n"), ":3: YRes '" + bad + "' is no");
    for (const std::string bad :
         {"1", "32769", "2147483648", "4294967295", "4294967296", "18446744073709551615"})
        refuse("a.gsf", field("XRes = 2\nYRes = " + bad + "\n"), ": 2 x " + bad + " samples, 2 to");
    refuse("a.gsf", field("XRes = 32768\nYRes = 32768\n"), ": 32768 x 32768 samples need 42949");
    refuse("a.gsf", field("XRes = 2\nYRes = 3\n"), ": 2 x 3 samples need");
    for (const std::string bad : {"0", "-1", "nan", "inf", "1e999", "1 m"})
        refuse("a.gsf", field("XRes = 2\nYRes = 2\nXReal = " + bad + "\n"),
               ":4: XReal '" + bad + "' is no positive length");
    refuse("a.gsf", field("XRes = 2\nYRes = 2\nAsperityBoundary = x\n"),
           ":4: AsperityBoundary 'x' is neither periodic nor finite");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    refuse("a.gsf", small_gsf().replace(48, 24, floats({nan, nan, nan, nan, nan, nan})),
           ": no point was measured");
}

TEST(Exr, RoundTripsHeightsExactly) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Heightfield s = random_surface(seed);
        write_heights(s, folder / "a.exr");
        const Heightfield read = read_heights(folder / "a.exr");
        EXPECT_EQ(read.nx, s.nx);
        EXPECT_EQ(read.ny, s.ny);
        EXPECT_EQ(read.heights, s.heights);
        EXPECT_EQ(read.boundary, Boundary::Finite);
        EXPECT_EQ(read.dx, 1.0);
    }
    EXPECT_EQ(folder.files(), 1);
}

TEST(TextMatrix, RoundTripsHeightsExactly) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Heightfield s = random_surface(seed);
        write_heights(s, folder / "a.txt");
        EXPECT_EQ(read_heights(folder / "a.txt").heights, s.heights);
        EXPECT_EQ(read_heights(folder / "a.txt").nx, s.nx);
    }
}

TEST(TextMatrix, AcceptsTheUsualSpellings) {
    const TemporaryFolder folder;
    for (const std::string text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6", "1;2;3\r\n4;5;6\r\n",
                                   "\t1\t 2 3 \n\n# x\n4 5 6 # y\n", "1, 2 3,\n4 ,5,6,\n",
                                   "\xef\xbb\xbf"
                                   "1 2 3\n4e0 .5e1 60e-1\n",
                                   "AsciiMatrix 3 2\n1 2 3\n4 5 6\n"}) {
        put(folder / "a.CSV", text);
        const Heightfield s = read_heights(folder / "a.CSV");
        EXPECT_EQ(s.nx, 3) << text;
        EXPECT_EQ(s.ny, 2) << text;
        EXPECT_EQ(s.heights, (std::vector<float>{1, 2, 3, 4, 5, 6})) << text;
    }
}

TEST(TextMatrix, RefusesWithTheLine) {
    refuse("a.txt", "", ": no numbers");
    refuse("a.txt", "# only\n\n", ": no numbers");
    refuse("a.txt", "1", ": 1 x 1 samples, 2 to 32768");
    refuse("a.txt", "1 2 3", ": 3 x 1 samples, 2 to");
    refuse("a.txt", "1 2\n\n3\n", ":3: 1 numbers, the rows above have 2");
    refuse("a.txt", "1 2\n3 4 5\n", ":2: 3 numbers, the rows above have 2");
    refuse("a.txt", "1 2\n3 nan\n", ": 1 of 4 points are missing (25 %)");
    refuse("a.txt", "1 2\n3 inf\n", ":2: 'inf' is not a number");
    refuse("a.txt", "1 2\n3 1e39\n", ":2: '1e39' is too large");
    refuse("a.txt", "1 2\n3 4x\n", ":2: '4x' is not a number");
    refuse("a.txt", "1 2\n3 \x01\xff\n", ":2: '?\?' is not a number");
    refuse("a.txt", "1,,2\n", ":1: a number is missing");
    refuse("a.txt", ",1,2\n", ":1: a number is missing");
    refuse("a.txt", "1,5;2,5\n1.5;2,5\n", ":2: '1.5' has a decimal point");
    refuse("a.txt", "AsciiMatrix 3\n1 2\n", ":1: AsciiMatrix needs a width and a height");
    refuse("a.txt", "AsciiMatrix -3 4294967295\n1 2\n", ":1: AsciiMatrix needs");
    refuse("a.txt", "AsciiMatrix 3 2\n1 2\n3 4\n", ": 3 x 2 numbers are announced, 2 x 2 found");
    refuse("a.txt", "1 2\nAsciiMatrix 2 2\n", ":2: 'AsciiMatrix' is not a number");
}

TEST(SurfaceFiles, RefuseFoldersMissingFilesAndUnknownEndings) {
    const TemporaryFolder folder;
    for (const std::string ending : {".gsf", ".exr", ".png", ".txt"}) {
        std::filesystem::create_directory(folder / ("folder" + ending));
        expect_error(ErrorCode::InputOutput, "cannot read: it is a folder",
                     [&] { read_heights(folder / ("folder" + ending)); });
        expect_error(ErrorCode::InputOutput, "none" + ending + ": cannot open: No such file",
                     [&] { read_heights(folder / ("none" + ending)); });
    }
    put(folder / "a.unknown", "\1\2");
    expect_error(ErrorCode::InvalidInput, "a.unknown: neither its first bytes nor its ending",
                 [&] { read_heights(folder / "a.unknown"); });
    expect_error(ErrorCode::Usage, "a.png: heights are written to .gsf",
                 [&] { write_heights(random_surface(1), folder / "a.png"); });
    expect_error(ErrorCode::InputOutput, "none/a.exr: cannot create",
                 [&] { write_heights(random_surface(1), folder / "none/a.exr"); });
    Heightfield broken = random_surface(1);
    broken.heights[0] = std::numeric_limits<float>::infinity();
    expect_error(ErrorCode::InvalidInput, "not a finite number",
                 [&] { write_heights(broken, folder / "a.gsf"); });
}

// Whatever is done to a file, reading it ends with an error of ours or with a valid surface.
void expect_error_or_surface(const std::string& path) {
    const auto error = error_of([&] { validate(read_heights(path), path); });
    if (!error) return;
    EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
    EXPECT_EQ(std::string(error->what()).find(path), 0u) << error->what();
}

TEST(SurfaceFiles, CutAndDamagedFilesNeverCrash) {
    const TemporaryFolder folder;
    const Heightfield s = random_surface(3);
    for (const std::string name : {"a.gsf", "a.exr", "a.txt"}) {
        const std::string path = folder / name;
        write_heights(s, path);
        test::with_each_byte_damaged(path, 600,
                                     [&](std::size_t) { expect_error_or_surface(path); });
        test::with_each_cut(path, [&](std::uintmax_t length) {
            const auto error = error_of([&] { read_heights(path); });
            // A text may still be a matrix when rows or digits are gone.
            ASSERT_TRUE(error || name == "a.txt") << name << " of " << length << " bytes";
            EXPECT_TRUE(!error || error->code() == ErrorCode::InvalidInput) << error->what();
        });
    }
}

// 3 x 3 heights 0 .. 8; a mirror at the first and the last row and column, each standing once.
TEST(LoadSurface, MirrorsWithoutDoublingTheEdge) {
    const TemporaryFolder folder;
    put(folder / "a.txt", "0 1 2\n3 4 5\n6 7 8\n");
    const Heightfield s = load(settings_for(folder / "a.txt"));
    EXPECT_EQ(s.nx, 4);
    EXPECT_EQ(s.ny, 4);
    EXPECT_EQ(s.boundary, Boundary::Periodic);
    EXPECT_EQ(s.heights, (std::vector<float>{0, 1, 2, 1,  //
                                             3, 4, 5, 4,  //
                                             6, 7, 8, 7,  //
                                             3, 4, 5, 4}));
    Heightfield wide;
    wide.nx = 16386, wide.ny = 2, wide.heights.assign(2 * 16386, 0.0f);
    expect_error(ErrorCode::InvalidInput, "mirrored it has 32770 x 2 samples",
                 [&] { mirrored(wide); });
    wide.nx = 16385, wide.heights.assign(2 * 16385, 0.0f);
    EXPECT_EQ(mirrored(wide).nx, 32768);
}

// A groove or noise repeats as it is; a slope, whose edges are a whole rise apart, does not, and
// neither does half a wave; a file of ours that says periodic is believed.
TEST(LoadSurface, RepeatsAFileWhoseEdgesFit) {
    const TemporaryFolder folder;
    const auto tiling_of = [&](const char* text) {
        put(folder / "a.txt", text);
        return load(settings_for(folder / "a.txt"));
    };
    const Heightfield groove = tiling_of("0 1 2 1\n0 1 2 1\n0 1 2 1\n");
    EXPECT_EQ(groove.nx, 4);
    EXPECT_EQ(groove.ny, 3);
    EXPECT_EQ(groove.boundary, Boundary::Periodic);
    EXPECT_EQ(groove.tiling, "periodic, as its opposite edges fit");
    // Saw teeth of three cells: the step back is as large inside as from the last to the first.
    EXPECT_EQ(tiling_of("0 1 2 0 1 2\n0 1 2 0 1 2\n").nx, 6);
    EXPECT_EQ(tiling_of("0 1 2 3\n0 1 2 3\n").nx, 6);
    EXPECT_EQ(tiling_of("0 0\n1 1\n2 2\n").ny, 4);
    EXPECT_EQ(tiling_of("0 0 0.4 0.8 1\n0 0 0.4 0.8 1\n").tiling,
              "mirrored to a periodic tile, as its opposite edges do not fit");
}

TEST(LoadSurface, AppliesTheSettings) {
    const TemporaryFolder folder;
    put(folder / "a.txt", "0 1 2\n3 4 5\n");
    SurfaceSettings settings = settings_for(folder / "a.txt");
    settings.height_scale = -0.5;
    settings.cell_x = 2.0;
    settings.diagonal = Diagonal::Main;
    settings.tiling = Tiling::Periodic;
    Heightfield s = load(settings);
    EXPECT_EQ(s.boundary, Boundary::Periodic);
    EXPECT_EQ(s.heights, (std::vector<float>{-0.0f, -0.5f, -1.0f, -1.5f, -2.0f, -2.5f}));
    EXPECT_EQ(s.dx, 2.0);
    EXPECT_EQ(s.dy, 2.0);
    EXPECT_EQ(s.diagonal, Diagonal::Main);
    settings.cell_y = 3.0;
    settings.tiling = Tiling::Finite;
    s = load(settings);
    EXPECT_EQ(s.dy, 3.0);
    EXPECT_EQ(s.boundary, Boundary::Finite);
    EXPECT_EQ(s.cells_x(), 2);
    settings.height_scale = 1e300;
    expect_error(ErrorCode::InvalidInput, "a.txt: height at row 0, column 1 is not a finite number",
                 [&] { load(settings); });
    expect_error(ErrorCode::Usage, "surface: the file name is empty",
                 [&] { load(settings_for("")); });
}

TEST(LoadSurface, AskedForAPatchAPeriodicFileBecomesOne) {
    const TemporaryFolder folder;
    Heightfield periodic = random_surface(1);
    periodic.boundary = Boundary::Periodic;
    periodic.diagonal = Diagonal::Main;
    write_heights(periodic, folder / "a.gsf");
    SurfaceSettings settings = settings_for(folder / "a.gsf");
    settings.tiling = Tiling::Finite;
    const Heightfield s = load(settings);
    EXPECT_EQ(s.boundary, Boundary::Finite);
    EXPECT_EQ(s.heights, periodic.heights);
    EXPECT_EQ(s.diagonal, Diagonal::Main);
}

}  // namespace
}  // namespace asperity::io
