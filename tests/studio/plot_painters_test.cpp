// SPDX-License-Identifier: Apache-2.0
// The painters of the plots: pixels where known data must be.
#include "plots_testing.h"
#include "view/plot_canvas.h"
#include "view/qt_canvas.h"

#include <asperity/core/directions.h>
#include <asperity/plots/files/write_plot.h>
#include <asperity/plots/plot_disc.h>
#include <asperity/plots/plot_frame.h>
#include <asperity/plots/plot_polar.h>

#include <QFontInfo>
#include <QTest>

#include <cmath>

namespace asperity::studio {
namespace {

using namespace plots;
using test::difference;
using test::distance_near;

const QSize kSize(600, 400);
const Box kArea{0, 0, 600, 400};

CurveSet line_from(double x0, double y0, double x1, double y1, double error) {
    CurveSet set;
    set.x_name = set.x_column = "x";
    PlotCurve curve;
    curve.name = "a";
    curve.column = "a [1]";
    curve.x = {x0, x1};
    curve.y = {y0, y1};
    curve.error = {error, error};
    curve.cells = {7, 8};
    set.curves.push_back(curve);
    return set;
}

/// Black on white.
PlotStyle print_style() {
    QPalette print;
    print.setColor(QPalette::Base, Qt::white);
    print.setColor(QPalette::Text, Qt::black);
    return style_of(print, QFont());
}

QImage picture(const Plot& plot, const PlotStyle& style) {
    return plot_image(plot, kSize, 1, style, QFont());
}

QColor ink(const PlotStyle& style, PlotInk what) {
    return to_qt(style.ink(what));
}

}  // namespace

class PlotPaintersTest : public QObject {
    Q_OBJECT

  private slots:
    void ticks_are_round_numbers();
    void a_line_goes_through_its_points();
    void a_log_axis_is_even_in_factors();
    void the_band_is_one_error_wide();
    void a_curve_beyond_the_axes_is_cut_off();
    void polar_angles_and_radii();
    void reading_gives_value_error_and_cell();
    void a_lit_cell_is_where_it_belongs();
    void the_same_plot_as_in_a_file();
};

void PlotPaintersTest::ticks_are_round_numbers() {
    const auto labels = [](const PlotAxis& axis, int count) {
        std::vector<std::string> texts;
        for (const PlotTick& tick : axis.ticks(count))
            if (!tick.label.empty()) texts.push_back(tick.label);
        return texts;
    };
    QCOMPARE(labels({{}, 0, 1, false, 0}, 5),
             std::vector<std::string>({"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    QCOMPARE(labels({{}, -90, 90, false, 45}, 9),
             std::vector<std::string>({"−90", "−45", "0", "45", "90"}));
    QCOMPARE(labels({{}, 1e-2, 10, true, 0}, 9),
             std::vector<std::string>({"10⁻²", "10⁻¹", "10⁰", "10¹"}));
    QCOMPARE(labels({{}, 0, 4e-5, false, 0}, 4),
             std::vector<std::string>({"0", "1×10⁻⁵", "2×10⁻⁵", "3×10⁻⁵", "4×10⁻⁵"}));
    QCOMPARE(axis_up_to(0.83, false, 4).high, 1.0);
    QCOMPARE(axis_up_to(3.1, true, 4).high, 10.0);
    QCOMPARE(axis_up_to(3.1, true, 4).low, 1e-3);
}

void PlotPaintersTest::a_line_goes_through_its_points() {
    const PlotStyle style = print_style();
    const CurvePlot plot(line_from(0, 0, 10, 5, 0), {"x", 0, 10}, {"y", 0, 8});
    const QImage image = picture(plot, style);
    const PlotFrame frame = plot.frame(kArea, style);
    for (const double x : {2.0, 5.0, 8.5}) {
        QVERIFY(distance_near(image, to_qt(frame.map(x, x / 2)), ink(style, PlotInk::Simulated)) <
                40);
        QVERIFY(distance_near(image, to_qt(frame.map(x, x / 2 + 1)),
                              ink(style, PlotInk::Simulated)) > 80);
    }
}

void PlotPaintersTest::a_log_axis_is_even_in_factors() {
    const PlotStyle style = print_style();
    const CurvePlot plot(line_from(0, 10, 10, 10, 0), {"x", 0, 10}, {"y", 1, 100, true});
    const QImage image = picture(plot, style);
    const Box inside = plot.frame(kArea, style).inside();
    const Place middle = inside.centre() + Place{3, 0};
    QVERIFY(distance_near(image, to_qt(middle), ink(style, PlotInk::Simulated)) < 40);
    QVERIFY(distance_near(image, to_qt(middle + Place{0, 12}), ink(style, PlotInk::Simulated)) >
            80);
}

void PlotPaintersTest::the_band_is_one_error_wide() {
    const PlotStyle style = print_style();
    CurveSet set = line_from(0, 5, 10, 5, 2);
    const auto pixel = [&](double y) {
        const CurvePlot plot(set, {"x", 0, 10}, {"y", 0, 10});
        const Place place = plot.frame(kArea, style).map(5.3, y);
        return picture(plot, style).pixelColor(to_qt(place).toPoint());
    };
    QVERIFY(difference(pixel(6.7), to_qt(style.paper)) > 20);
    QVERIFY(difference(pixel(3.3), to_qt(style.paper)) > 20);
    QVERIFY(difference(pixel(7.4), to_qt(style.paper)) < 5);
    set.error_band = false;
    QVERIFY(difference(pixel(6.7), to_qt(style.paper)) < 5);
}

void PlotPaintersTest::a_curve_beyond_the_axes_is_cut_off() {
    const PlotStyle style = print_style();
    const CurvePlot plot(line_from(0, -10, 10, 30, 0), {"x", 0, 10}, {"y", 0, 10});
    const QImage image = picture(plot, style);
    const PlotFrame frame = plot.frame(kArea, style);
    QVERIFY(distance_near(image, to_qt(frame.map(3.75, 5)), ink(style, PlotInk::Simulated)) < 40);
    for (const Place outside : {frame.map(5.3, 11.2), frame.map(2.2, -1.2)})
        QVERIFY(distance_near(image, to_qt(outside), ink(style, PlotInk::Simulated)) > 80);
}

void PlotPaintersTest::polar_angles_and_radii() {
    const PlotStyle style = print_style();
    const PolarPlot plot(line_from(20, 0.5, 40, 0.5, 0), {"f", 0, 1}, {60});
    const PolarFrame frame = plot.frame(kArea, style);
    const Place place = frame.centre() +
                        0.5 * frame.radius() * Place{std::sin(radians(40)), -std::cos(radians(40))};
    const QImage image = picture(plot, style);
    QVERIFY(distance_near(image, to_qt(place), ink(style, PlotInk::Simulated)) < 40);
    // The light comes from the left, along -60 degrees
    QVERIFY(distance_near(image, to_qt(frame.map(-60, 0.8)), ink(style, PlotInk::Light)) < 40);
    QVERIFY(distance_near(image, to_qt(frame.map(-50, 0.8)), ink(style, PlotInk::Light)) > 60);
    QVERIFY(std::abs(*frame.theta_at(frame.map(-35, 0.7)) + 35) < 1e-9);
    QVERIFY(!frame.theta_at(frame.centre() + Place{0, 5}));
}

void PlotPaintersTest::reading_gives_value_error_and_cell() {
    const PlotStyle style = print_style();
    const CurvePlot plot(line_from(0, 2, 10, 5, 0.25), {"x", 0, 10}, {"y", 0, 8});
    const PlotFrame frame = plot.frame(kArea, style);
    const auto reading = plot.reading(frame.map(8, 1), kArea, style);
    QVERIFY(reading);
    QCOMPARE(reading->cell, std::optional<int>(8));
    QVERIFY2(reading->text.find("a: 5 ± 0.25") != std::string::npos, reading->text.c_str());
    QVERIFY(reading->dots.front().place == frame.map(10, 5));
    QVERIFY(!plot.reading({1, 1}, kArea, style));
}

void PlotPaintersTest::a_lit_cell_is_where_it_belongs() {
    DiscPainter painter;
    const io::ValueScale scale{io::Scale::Linear, 0, 2};
    const io::Colour top = io::colour_of(io::ColourMap::Viridis, 1);
    const QColor lit = QColor::fromRgbF(static_cast<float>(top.r), static_cast<float>(top.g),
                                        static_cast<float>(top.b));
    for (const int resolution : {16, 13}) {  // columns that mirror, and some that do not
        DetectorSettings settings;
        settings.resolution = resolution;
        const Detector detector(settings);
        for (int cell = 0; cell < detector.cells(); ++cell) {
            std::vector<double> values(static_cast<std::size_t>(detector.cells()));
            values[static_cast<std::size_t>(cell)] = 2;
            const Raster raster =
                painter.paint(400, detector, values, scale, io::ColourMap::Viridis);
            for (int other = 0; other < detector.cells(); ++other) {
                const Vec3 w = detector.centre(other);
                const QPoint place(static_cast<int>(200 + 200 * w.x),
                                   static_cast<int>(200 - 200 * w.y));
                const int from_lit =
                    difference(QColor::fromRgba(raster.at(place.x(), place.y())), lit);
                QVERIFY2(other == cell ? from_lit < 3 : from_lit > 100,
                         qPrintable(QString("cell %1 at cell %2").arg(cell).arg(other)));
            }
        }
    }
}

/// Qt and Cairo draw the same painters: but for letters and smooth edges the pixels are equal.
void PlotPaintersTest::the_same_plot_as_in_a_file() {
    CurveSet set = line_from(-60, 0.2, 70, 0.9, 0.1);
    const PolarPlot polar(set, {"f", 0, 1}, {30});
    const CurvePlot straight(set, {"x", -90, 90, false, 30}, {"y", 0, 1});
    for (const Plot* plot :
         {static_cast<const Plot*>(&polar), static_cast<const Plot*>(&straight)}) {
        PlotFileSettings settings;
        settings.width = kSize.width();
        settings.height = kSize.height();
        settings.font_size = QFontInfo(QFont()).pixelSize();
        settings.scale = 1;
        const std::string png = plot_bytes(*plot, settings, "png");
        QImage file;
        QVERIFY(file.loadFromData(reinterpret_cast<const uchar*>(png.data()),
                                  static_cast<int>(png.size()), "PNG"));
        QCOMPARE(file.size(), kSize);
        const QImage widget = picture(*plot, print_style());
        int unlike = 0, inked = 0;
        for (int y = 0; y < kSize.height(); ++y)
            for (int x = 0; x < kSize.width(); ++x) {
                unlike += difference(file.pixelColor(x, y), widget.pixelColor(x, y)) > 96;
                inked += difference(file.pixelColor(x, y), Qt::white) > 96;
            }
        QVERIFY(inked > 1500);
        QVERIFY2(unlike < 0.25 * inked, qPrintable(QString("%1 of %2").arg(unlike).arg(inked)));
    }
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::PlotPaintersTest)
#include "plot_painters_test.moc"
