// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/files/write_plot.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/plots/files/cairo_canvas.h>
#include <asperity/plots/plot_frame.h>
#include <fmt/format.h>

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

namespace asperity::plots {
namespace {

CurveSet set_of(std::vector<double> x, std::vector<double> y) {
    PlotCurve curve;
    curve.name = "line, \"quoted\"";
    curve.column = curve.name;
    curve.x = std::move(x);
    curve.y = std::move(y);
    CurveSet set;
    set.title = "A title";
    set.x_name = set.x_column = "x";
    set.curves = {curve};
    return set;
}

const CurvePlot kPlot(set_of({0, 4, 10}, {1, 7, 2}), {"x", 0, 10}, {"y", 0, 8});
const PlotFileSettings kSettings = {.width = 600, .height = 400, .font_size = 12};

/// All the places that paths of an SVG file go through.
std::vector<Place> places_of(const std::string& svg) {
    static const std::regex kPlace("[ML] ([-0-9.]+) ([-0-9.]+)");
    std::vector<Place> places;
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), kPlace);
         it != std::sregex_iterator(); ++it)
        places.push_back({*parse_double((*it)[1].str()), *parse_double((*it)[2].str())});
    return places;
}

bool has(const std::vector<Place>& places, Place wanted) {
    return std::any_of(places.begin(), places.end(), [&](Place place) {
        return std::hypot(place.x - wanted.x, place.y - wanted.y) < 0.01;
    });
}

TEST(WritePlot, SvgHasTheCurvesPointsWhereTheAxesPutThem) {
    const std::string svg = plot_bytes(kPlot, kSettings, "svg");
    EXPECT_NE(svg.find("width=\"600px\""), std::string::npos);
    const PlotStyle style = PlotStyle::light(std::make_shared<CairoMeasure>(), 12);
    const Box inside = kPlot.frame({0, 0, 600, 400}, style).inside();
    const std::vector<Place> places = places_of(svg);
    for (const auto& [x, y] : {std::pair{0.0, 1.0}, {4.0, 7.0}, {10.0, 2.0}}) {
        const Place place{inside.left + x / 10 * inside.width,
                          inside.bottom() - y / 8 * inside.height};
        EXPECT_TRUE(has(places, place)) << place.x << ' ' << place.y;
        EXPECT_FALSE(has(places, place + Place{3.7, 5.3}));
    }
}

TEST(WritePlot, PdfIsWholeAndTheSameAgainButForItsDate) {
    const std::string pdf = plot_bytes(kPlot, kSettings, "pdf");
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
    // 600 x 400 CSS pixels are 450 x 300 points
    EXPECT_NE(pdf.find("/MediaBox [ 0 0 450 300 ]"), std::string::npos);
}

TEST(WritePlot, PngIsThePlotInPixels) {
    for (const bool dark : {false, true}) {
        PlotFileSettings settings = kSettings;
        settings.dark = dark;
        settings.scale = 1.5;
        const std::string png = plot_bytes(kPlot, settings, "png");
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size()));
        image.format = PNG_FORMAT_GRAY;
        EXPECT_EQ(image.width, 900u);
        EXPECT_EQ(image.height, 600u);
        std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
        ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
        const auto paper = std::count(pixels.begin(), pixels.end(), pixels.front());
        EXPECT_EQ(pixels.front() < 128, dark);
        EXPECT_GT(paper, 450000);         // most of it is paper
        EXPECT_LT(paper, 540000 - 5000);  // but not all
    }
}

TEST(WritePlot, CsvIsTheTable) {
    EXPECT_EQ(plot_bytes(kPlot, kSettings, "csv"), "x,\"line, \"\"quoted\"\"\"\n0,1\n4,7\n10,2\n");
}

TEST(WritePlot, OtherEndingsAndFullDisksAreErrors) {
    const auto code_of = [](const std::string& path) {
        try {
            write_plot(kPlot, kSettings, path);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode{};
    };
    EXPECT_EQ(code_of("plot.jpeg"), ErrorCode::Usage);
    EXPECT_EQ(code_of("plot"), ErrorCode::Usage);
    EXPECT_EQ(code_of("no such folder/plot.svg"), ErrorCode::InputOutput);
    // A device that is always full, under each ending
    for (const char* ending : {"svg", "pdf", "png", "csv"}) {
        const std::string full =
            fmt::format("{}full_{}.{}", testing::TempDir(), ::getpid(), ending);
        std::filesystem::create_symlink("/dev/full", full);
        EXPECT_EQ(code_of(full), ErrorCode::InputOutput) << ending;
        std::filesystem::remove(full);
    }
}

}  // namespace
}  // namespace asperity::plots
