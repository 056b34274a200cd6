// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/test_files.h>
#include <asperity/pictures/colour_map.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/picture_test_data.h>
#include <asperity/pictures/pictures.h>

#include <cmath>

namespace asperity::io {
namespace {

using test::ReadPng;

int bright(const std::vector<int>& pixel) {
    return pixel[0] + pixel[1] + pixel[2];
}

/// One bright cell, the one that holds theta_o 45 degrees, phi_o 90 degrees, and nothing else.
Measurement one_cell(DetectorKind kind, int resolution) {
    Measurement m = test::empty_measurement(kind, resolution, {"all"}, {0});
    const int cell = m.detector.cell_of(from_spherical(radians(45.5), radians(90.5)));
    test::add_rays(m, m.layers[0], 0, 0, cell, 500);
    return m;
}

SkyMapSettings bare(Projection projection) {
    SkyMapSettings settings;
    settings.projection = projection;
    settings.legend = false;
    return settings;
}

// Resolution 64: 64 x 32 cells of 16 pixels. 45 degrees = row 16, 90 degrees = column 16.
TEST(LayerPng, SkyMapShowsACellWhereItsAnglesAre) {
    const test::TemporaryFolder folder;
    const Measurement m = one_cell(DetectorKind::LatLong, 64);
    write_layer_png(m, m.layers[0], folder / "a.png", bare(Projection::SkyMap));
    const ReadPng png(folder / "a.png");
    ASSERT_EQ(png.width, 1024);
    ASSERT_EQ(png.height, 512);
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 1024; ++x) {
            const bool inside = x / 16 == 16 && y / 16 == 16;
            ASSERT_EQ(bright(png.at(x, y)) > 0, inside) << x << ", " << y;
        }
    }
}

// Rows of equal sin^2: 45 degrees = the middle row of 32, which ends at asin(sqrt(17/32)) = 46.79
// degrees: of 512 pixels for 90 degrees, lines 256 .. 265.
TEST(LayerPng, SkyMapOfEqualAreaRowsIsStillEvenInTheta) {
    const test::TemporaryFolder folder;
    const Measurement m = one_cell(DetectorKind::EqualArea, 64);
    write_layer_png(m, m.layers[0], folder / "a.png", bare(Projection::SkyMap));
    const ReadPng png(folder / "a.png");
    ASSERT_EQ(png.height, 512);
    const int x = 16 * 16 + 8;
    EXPECT_EQ(bright(png.at(x, 254)), 0);
    EXPECT_GT(bright(png.at(x, 256)), 0);
    EXPECT_GT(bright(png.at(x, 265)), 0);
    EXPECT_EQ(bright(png.at(x, 267)), 0);
}

// phi_o = 90 degrees is up, radius sin(theta_o): the cell's middle at theta 46.4, phi 92.8 degrees.
TEST(LayerPng, DiskShowsTheHemisphereFromAbove) {
    const test::TemporaryFolder folder;
    const Measurement m = one_cell(DetectorKind::LatLong, 64);
    write_layer_png(m, m.layers[0], folder / "a.png", bare(Projection::Disk));
    const ReadPng png(folder / "a.png");
    ASSERT_EQ(png.width, png.height);
    const auto pixel = [&](double theta_deg, double phi_deg) {
        const double r = 0.5 * png.width * std::sin(radians(theta_deg)), phi = radians(phi_deg);
        return bright(png.at(static_cast<int>(0.5 * png.width + r * std::cos(phi)),
                             static_cast<int>(0.5 * png.width - r * std::sin(phi))));
    };
    EXPECT_GT(pixel(46.4, 92.8), 300);
    EXPECT_EQ(pixel(46.4, 272.8), 0);
    EXPECT_EQ(pixel(46.4, 2.8), 0);
    EXPECT_EQ(pixel(40, 92.8), 0);
    EXPECT_EQ(pixel(46.4, 98), 0);
}

TEST(LayerPng, ColoursFollowTheScale) {
    const test::TemporaryFolder folder;
    Measurement m = test::empty_measurement(DetectorKind::EqualArea, 8, {"all"}, {0});
    // Cells of pi / 32 sr: 1000 rays, so n rays in a cell are f = n / 1000 * 32 / pi [1/sr].
    const double unit = 1000 * kPi / 32;
    test::add_rays(m, m.layers[0], 0, 0, 0, unit * 1);
    test::add_rays(m, m.layers[0], 1, 0, 1, unit * 0.1);
    test::add_rays(m, m.layers[0], 0, 0, 2, unit * 1e-6);
    const auto cell_colours = [&](const SkyMapSettings& settings) {
        write_layer_png(m, m.layers[0], folder / "a.png", settings);
        const ReadPng png(folder / "a.png");
        const int step = png.width / 8;
        return std::vector{png.at(step / 2, 4), png.at(step * 3 / 2, 4), png.at(step * 5 / 2, 4),
                           png.at(step * 7 / 2, 4)};
    };
    SkyMapSettings settings = bare(Projection::SkyMap);
    settings.colour_map = ColourMap::Viridis;
    settings.decades = 2;
    const auto near = [](const std::vector<int>& a, Colour colour) {
        const std::vector<int> b = test::rgb(colour);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1);
    };
    const auto log = cell_colours(settings);
    near(log[0], colour_of(ColourMap::Viridis, 1));
    near(log[1], colour_of(ColourMap::Viridis, 0.5));
    near(log[2], colour_of(ColourMap::Viridis, 0));
    near(log[3], kZeroColour);
    settings.scale = Scale::Linear;
    near(cell_colours(settings)[1], colour_of(ColourMap::Viridis, 0.1));
}

TEST(LayerPng, ShowsOneChannelOrTheMean) {
    Measurement m = test::empty_measurement(DetectorKind::EqualArea, 8, {"R", "G", "B"}, {0});
    const double unit = 1000 * kPi / 32;
    for (int c = 0; c < 3; ++c) test::add_rays(m, m.layers[0], 0, c, 5, unit * (c + 1));
    EXPECT_NEAR(values_of(m, m.layers[0], 1)[5], 2, 1e-6);
    EXPECT_NEAR(values_of(m, m.layers[0], -1)[5], 2, 1e-6);
    EXPECT_NEAR(values_of(m, m.layers[0], 2)[5], 3, 1e-6);
    EXPECT_NEAR(shown_albedo(m, m.layers[0], 2), 3 * kPi / 32, 1e-6);
}

// Half a ray of 1000 in a cell at the pole, 1.2e-4 sr: f = 4.2; the rest spread evenly, f = 0.32.
// The stray light is less than a thousandth of the energy and does not take the scale.
TEST(LayerPng, StrayRaysAtThePoleDoNotTakeTheScale) {
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 64, {"all"}, {0});
    for (int cell = 0; cell < m.detector.cells(); ++cell) {
        const double share = m.detector.projected_solid_angle(cell / 64) / kPi;
        test::add_rays(m, m.layers[0], 0, 0, cell, 999 * share);
    }
    test::add_rays(m, m.layers[0], 0, 0, 3, 0.5);
    const ValueScale scale = value_scale(m, {&m.layers[0]}, SkyMapSettings{});
    EXPECT_DOUBLE_EQ(scale.high, 0.5);
    EXPECT_TRUE(scale.clipped);
    EXPECT_EQ(ticks_of(scale).back().label, "≥ 0.5");
}

TEST(LayerPng, PixelsLargerThanCellsShowTheMean) {
    // Disk of 880 pixels: at resolution 512 hundreds of cells meet in the middle pixels. Every
    // second cell of a row lit: the mean is half, everywhere.
    Measurement m = test::empty_measurement(DetectorKind::EqualArea, 512, {"all"}, {0});
    for (int cell = 0; cell < m.detector.cells(); cell += 2)
        test::add_rays(m, m.layers[0], 0, 0, cell, 0.0078125);
    const double lit = values_of(m, m.layers[0], 0)[0];
    ValueScale scale;
    scale.scale = Scale::Linear;
    scale.high = lit;
    SkyMapSettings settings;
    settings.projection = Projection::SkyMap;
    settings.colour_map = ColourMap::Grey;
    Canvas canvas(64, 32, {});
    paint_layer(canvas, {0, 0, 64, 32}, m, m.layers[0], scale, settings);
    for (int y = 0; y < 32; ++y)
        EXPECT_NEAR(canvas.get(20, y).g, colour_of(ColourMap::Grey, 0.5).g, 0.02) << y;
}

TEST(LayerPng, NothingAtAllIsDrawnBlack) {
    const test::TemporaryFolder folder;
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 32, {"all"}, {0, 60});
    m.layers[1].rays = 0;  // a run stopped before its first batch
    for (const Projection projection : {Projection::SkyMap, Projection::Disk}) {
        SkyMapSettings settings = bare(projection);
        settings.scale = projection == Projection::Disk ? Scale::Linear : Scale::Log;
        write_layer_png(m, m.layers[1], folder / "a.png", settings);
        const ReadPng png(folder / "a.png");
        EXPECT_EQ(bright(png.at(png.width / 2, png.height / 2)), 0);
        settings.legend = true;
        write_layer_png(m, m.layers[0], folder / "b.png", settings);
        EXPECT_GT(ReadPng(folder / "b.png").width, 1000);
        write_layer_sheet(m, folder / "c.png", settings);
        EXPECT_EQ(ReadPng(folder / "c.png").width, 1600);
    }
}

TEST(LayerPng, EveryResolutionGivesAPictureOfUsefulSize) {
    const test::TemporaryFolder folder;
    using Case = std::pair<DetectorKind, int>;
    for (const auto& [kind, resolution] :
         {Case{DetectorKind::LatLong, 2}, Case{DetectorKind::LatLong, 1200},
          Case{DetectorKind::EqualArea, 3}, Case{DetectorKind::EqualArea, 300}}) {
        const Measurement m = one_cell(kind, resolution);
        for (const Projection projection : {Projection::SkyMap, Projection::Disk}) {
            write_layer_png(m, m.layers[0], folder / "a.png", bare(projection));
            const ReadPng png(folder / "a.png");
            EXPECT_GE(png.width, std::max(660, resolution));
            EXPECT_LE(png.width, std::max(1400, 2 * resolution));
        }
    }
}

TEST(LayerPng, WritesAFolderOfLayers) {
    const test::TemporaryFolder folder;
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 16, {"all"}, {0, 22.5, 84});
    m.layers[2].number = 115;
    const auto names = write_layer_pngs(m, folder / "new/layers", SkyMapSettings{});
    ASSERT_EQ(names.size(), 3U);
    EXPECT_EQ(names[0], folder / "new/layers/layer_001_theta_00.png");
    EXPECT_EQ(names[1], folder / "new/layers/layer_002_theta_22.50.png");
    EXPECT_EQ(names[2], folder / "new/layers/layer_115_theta_84.png");
    for (const std::string& name : names) EXPECT_GT(ReadPng(name).width, 1000);

    m.experiment.illumination.phi_deg = {0, 30};
    m.layers[1].phi_i = radians(30);
    const auto with_azimuth = write_layer_pngs(m, folder / "new/layers", SkyMapSettings{});
    EXPECT_EQ(with_azimuth[1], folder / "new/layers/layer_002_theta_22.50_phi_030.png");
}

TEST(LayerPng, RefusesWhatDoesNotFit) {
    const test::TemporaryFolder folder;
    const Measurement m = one_cell(DetectorKind::LatLong, 16);
    SkyMapSettings settings;
    settings.channel = 1;
    const auto write = [&] { write_layer_png(m, m.layers[0], folder / "a.png", settings); };
    test::expect_error(ErrorCode::Usage, "channel", write);
    settings.channel = -1;
    for (const double decades : {0.0, -1.0, std::nan(""), 1e9}) {
        settings.decades = decades;
        test::expect_error(ErrorCode::Usage, "decades", write);
    }
    test::put(folder / "file", "in the way");
    test::expect_error(ErrorCode::InputOutput, "file",
                       [&] { write_layer_pngs(m, folder / "file", SkyMapSettings{}); });
    EXPECT_EQ(folder.files(), 1);
}

TEST(LayerSheet, HoldsFifteenDisksInThreeRows) {
    const test::TemporaryFolder folder;
    std::vector<double> angles;
    for (int layer = 15; layer >= 1; --layer) angles.push_back(90.0 - 6 * layer);
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 32, {"all"}, angles);
    for (Layer& layer : m.layers)
        for (int cell = 0; cell < m.detector.cells(); ++cell)
            test::add_rays(m, layer, 0, 0, cell, 0.5);
    SkyMapSettings settings = bare(Projection::Disk);
    write_layer_sheet(m, folder / "a.png", settings);
    const ReadPng png(folder / "a.png");
    ASSERT_EQ(png.width, 1600);
    // 64 pixels of margin; five columns with 36 between: 265 wide, one every 301.
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 5; ++column) {
            const int x = 65 + column * 301, y = 64 + row * 301;
            EXPECT_GT(bright(png.at(x + 132, y + 100)), 200) << row << ", " << column;
            EXPECT_LT(bright(png.at(x - 10, y + 132)), 100) << row << ", " << column;
        }
    }
}

// The first layer reflects everywhere, the second into one cell: beside that the first is dark on a
// linear scale of both, and as bright as can be on its own.
TEST(LayerSheet, EachPictureMayHaveItsOwnScale) {
    const test::TemporaryFolder folder;
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 32, {"all"}, {0, 30});
    for (int cell = 0; cell < m.detector.cells(); ++cell)
        test::add_rays(m, m.layers[0], 0, 0, cell, 0.5);
    for (int ray = 0; ray < 200; ++ray) test::add_rays(m, m.layers[1], 0, 0, 100, 1);
    SkyMapSettings settings = bare(Projection::SkyMap);
    settings.scale = Scale::Linear;
    const auto brightness_of_first = [&] {
        write_layer_sheet(m, folder / "a.png", settings);
        const ReadPng png(folder / "a.png");
        double sum = 0;
        for (int y = 70; y < png.height - 70; ++y)
            for (int x = 66; x < 600; ++x) sum += bright(png.at(x, y));
        return sum / (534 * (png.height - 140));
    };
    const double beside_the_other = brightness_of_first();
    settings.own_scales = true;
    EXPECT_GT(brightness_of_first(), 1.25 * beside_the_other);
}

TEST(LayerSheet, IsDarkOnWhiteForPaper) {
    const test::TemporaryFolder folder;
    Measurement m = test::empty_measurement(DetectorKind::LatLong, 32, {"all"}, {0});
    test::add_rays(m, m.layers[0], 0, 0, 5, 1);
    SkyMapSettings settings;
    for (const bool light : {false, true}) {
        settings.light = light;
        write_layer_sheet(m, folder / "sheet.png", settings);
        write_layer_png(m, m.layers[0], folder / "layer.png", settings);
        for (const char* name : {"sheet.png", "layer.png"}) {
            const ReadPng png(folder / name);
            EXPECT_EQ(png.at(3, 3) == (std::vector<int>{255, 255, 255}), light) << name;
        }
    }
}

TEST(LayerSheet, NeedsALayer) {
    const test::TemporaryFolder folder;
    const Measurement m = test::empty_measurement(DetectorKind::LatLong, 16, {"all"}, {});
    test::expect_error(ErrorCode::Usage, "no layer",
                       [&] { write_layer_sheet(m, folder / "a.png", SkyMapSettings{}); });
    EXPECT_EQ(folder.files(), 0);
}

TEST(Legend, TicksStandWhereTheirValuesAre) {
    const ValueScale log{Scale::Log, 5e-4, 5, false};
    for (const Tick& tick : ticks_of(log)) {
        if (tick.label.empty()) continue;
        EXPECT_NEAR(log.position(std::stod(tick.label)), tick.t, 1e-9) << tick.label;
    }
    EXPECT_EQ(ticks_of(log).back().label, "5");
    const ValueScale small{Scale::Log, 1e-9, 1e-5, true};
    EXPECT_EQ(ticks_of(small).front().label, "10⁻⁹");
    EXPECT_EQ(ticks_of(small).back().label, "≥ 10⁻⁵");
    const ValueScale linear{Scale::Linear, 0, 2, false};
    EXPECT_EQ(ticks_of(linear)[1].label, "0.4");
    EXPECT_NEAR(ticks_of(linear)[1].t, 0.2, 1e-12);
}

}  // namespace
}  // namespace asperity::io
