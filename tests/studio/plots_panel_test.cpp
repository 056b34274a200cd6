// SPDX-License-Identifier: Apache-2.0
// The panel of the plots: the numbers of its files beside the library's, and what mouse, keys and
// controls do.
#include "view/plots_panel.h"
#include "plots_testing.h"
#include "view/plot_canvas.h"
#include "view/qt_canvas.h"

#include <asperity/bsdf/models/microfacet.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/measured/normal_profile.h>
#include <asperity/plots/plot_axis.h>
#include <asperity/plots/plot_hemisphere.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <algorithm>
#include <cmath>

namespace asperity::studio {
namespace {

using test::distance_near;

const QSize kSize(600, 400);
const plots::Box kArea{0, 0, 600, 400};

/// A file's lines, cut at the commas.
QList<QStringList> rows_of_csv(const QString& path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return {};
    QList<QStringList> rows;
    for (const QByteArray& line : file.readAll().split('\n'))
        if (!line.isEmpty()) rows << QString::fromUtf8(line).split(',');
    return rows;
}

QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

}  // namespace

class PlotsPanelTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase();
    void init();
    void cleanup();

    void csv_holds_the_librarys_numbers();
    void albedo_csv_adds_up();
    void svg_is_a_drawing();
    void other_endings_are_refused();
    void png_is_black_on_white_in_a_dark_program();
    void click_on_the_hemisphere_selects_the_cell();
    void selected_cell_is_outlined();
    void read_out_shows_the_layer();
    void keys_move_the_cross_hair();
    void controls_are_steps_of_the_history();
    void models_follow_the_surface_or_the_slider();
    void normals_beside_the_surface();
    void another_layer_is_another_plot();

  private:
    plots::PlotStyle widget_style() const { return style_of(canvas_->palette(), canvas_->font()); }
    /// The plot that the panel shows of the current layer.
    plots::HemispherePlot hemisphere() {
        plots::HemispherePlot::Data data;
        data.title = "Layer 2, θᵢ = 45°";
        data.discs = {plots::hemisphere_values(*bench_.drawing().layers().head, layer(), -1)};
        return plots::HemispherePlot(std::move(data));
    }
    void show_kind(PlotKind kind, io::Scale scale = io::Scale::Linear);
    const Layer& layer();
    QString saved(const QString& name) const;

    Workbench bench_;
    std::unique_ptr<PlotsPanel> panel_;
    PlotCanvas* canvas_ = nullptr;
    QTemporaryDir folder_;
};

void PlotsPanelTest::initTestCase() {
    StudioSettings settings;
    settings.experiment.surface.kind = "gaussian";
    settings.experiment.surface.size = 64;
    settings.experiment.run.jitter = 8;
    settings.experiment.illumination.layers = 3;
    settings.experiment.detector.resolution = 32;
    settings.surface_view.current_layer = 2;
    bench_.document().reset(settings);
    QTRY_VERIFY_WITH_TIMEOUT(!bench_.surface().busy(), 60000);
    bench_.draw_to_textures();
    QTRY_VERIFY_WITH_TIMEOUT(bench_.drawing().layers().complete, 120000);
}

void PlotsPanelTest::init() {
    panel_ = std::make_unique<PlotsPanel>(bench_);
    panel_->resize(640, 640);
    panel_->show();
    QVERIFY(QTest::qWaitForWindowExposed(panel_.get()));
    canvas_ = panel_->findChild<PlotCanvas*>("plot-canvas");
    QVERIFY(canvas_ != nullptr);
}

void PlotsPanelTest::cleanup() {
    panel_.reset();
    bench_.select_cell(std::nullopt);
    while (bench_.document().undo_stack().canUndo()) bench_.document().undo_stack().undo();
}

void PlotsPanelTest::show_kind(PlotKind kind, io::Scale scale) {
    bench_.document().change("Plot Kind", [&](StudioSettings& s) {
        s.plots.kind = kind;
        s.plots.scale = scale;
    });
    QTRY_VERIFY_WITH_TIMEOUT(panel_->is_up_to_date(), 60000);
}

const Layer& PlotsPanelTest::layer() {
    return *bench_.drawing().layers().layer(2);
}

QString PlotsPanelTest::saved(const QString& name) const {
    const QString path = folder_.filePath(name);
    panel_->save(path);
    return path;
}

void PlotsPanelTest::csv_holds_the_librarys_numbers() {
    show_kind(PlotKind::LobeCartesian);
    const auto rows = rows_of_csv(saved("lobe.csv"));
    const LobeSlice slice = lobe_slice(*bench_.drawing().layers().head, layer(), -1);
    QCOMPARE(rows.size(), static_cast<qsizetype>(slice.samples.size()) + 1);
    QCOMPARE(rows[0][0], QString("theta_o [deg]"));
    QCOMPARE(rows[0][1], QString("simulated: f [1/sr]"));
    double sum = 0;
    for (qsizetype k = 0; k + 1 < rows.size(); ++k) {
        const LobeSample& sample = slice.samples[static_cast<std::size_t>(k)];
        const QStringList& row = rows[k + 1];
        QCOMPARE(row.size(), rows[0].size());
        QVERIFY(std::abs(row[0].toDouble() - degrees(sample.theta_o)) < 1e-12);
        QVERIFY(row[1].toDouble() == sample.f);
        QVERIFY(row[2].toDouble() == sample.f_stderr);
        QVERIFY(row[rows[0].indexOf("simulated: f cos(theta_o) [1/sr]")].toDouble() ==
                sample.f_cos);
        sum += sample.f;
    }
    QVERIFY(sum > 0);

    show_kind(PlotKind::Hemisphere);
    const auto cells = rows_of_csv(saved("hemisphere.csv"));
    const Measurement& head = *bench_.drawing().layers().head;
    QCOMPARE(cells.size(), static_cast<qsizetype>(head.detector.cells()) + 1);
    for (int cell = 0; cell < head.detector.cells(); ++cell)
        QVERIFY(cells[cell + 1][3].toDouble() == head.brdf(layer(), 0, cell));
}

void PlotsPanelTest::albedo_csv_adds_up() {
    show_kind(PlotKind::Albedo);
    bench_.document().change("models", [](StudioSettings& s) { s.plots.overlays.clear(); });
    QTRY_VERIFY_WITH_TIMEOUT(panel_->is_up_to_date(), 60000);
    const auto rows = rows_of_csv(saved("albedo.csv"));
    QCOMPARE(rows.size(), qsizetype(4));  // three layers
    for (qsizetype k = 1; k < rows.size(); ++k) {
        double orders = 0;
        for (int column = 3; column < 11; column += 2) orders += rows[k][column].toDouble();
        QVERIFY(std::abs(orders - rows[k][1].toDouble()) < 1e-9);
        QVERIFY(orders > 0.9);
    }
    // Normal incidence is the last layer and comes first
    const Measurement& head = *bench_.drawing().layers().head;
    const Layer& normal = *bench_.drawing().layers().layer(3);
    QVERIFY(rows[1][1].toDouble() == albedo_by_bounce(head, normal, 4, -1).total.value);
}

void PlotsPanelTest::svg_is_a_drawing() {
    for (const PlotKind kind :
         {PlotKind::LobePolar, PlotKind::LobeCartesian, PlotKind::Hemisphere, PlotKind::Albedo}) {
        show_kind(kind);
        QFile file(saved("plot.svg"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QXmlStreamReader xml(&file);
        int strokes = 0, letters = 0, images = 0;
        while (!xml.atEnd())
            if (xml.readNext() == QXmlStreamReader::StartElement) {
                if (xml.name() == QLatin1String("path") || xml.name() == QLatin1String("polyline"))
                    ++strokes;
                if (xml.name() == QLatin1String("use")) ++letters;
                if (xml.name() == QLatin1String("image")) ++images;
            }
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QVERIFY(strokes > 0);
        QVERIFY(letters > 50);
        QCOMPARE(images, kind == PlotKind::Hemisphere ? 2 : 0);  // the disc, the bar
    }
}

void PlotsPanelTest::other_endings_are_refused() {
    const auto code_of = [&](const QString& path) {
        try {
            panel_->save(path);
        } catch (const Error& error) {
            return static_cast<int>(error.code());
        }
        return 0;
    };
    QCOMPARE(code_of(folder_.filePath("plot.jpeg")), static_cast<int>(ErrorCode::Usage));
    QCOMPARE(code_of(folder_.filePath("no such folder/plot.csv")),
             static_cast<int>(ErrorCode::InputOutput));
}

void PlotsPanelTest::png_is_black_on_white_in_a_dark_program() {
    QPalette dark = panel_->palette();
    dark.setColor(QPalette::Base, QColor(20, 22, 25));
    dark.setColor(QPalette::Text, QColor(230, 230, 230));
    panel_->setPalette(dark);
    const QImage shown = panel_->picture(kSize);
    QCOMPARE(shown.size(), kSize);
    QCOMPARE(shown.pixelColor(2, kSize.height() - 2), QColor(20, 22, 25));
    const QImage file(saved("plot.png"));
    QCOMPARE(file.size(), 2 * canvas_->size());
    QCOMPARE(file.pixelColor(2, file.height() - 2), QColor(Qt::white));
}

void PlotsPanelTest::click_on_the_hemisphere_selects_the_cell() {
    show_kind(PlotKind::Hemisphere);
    const Measurement& head = *bench_.drawing().layers().head;
    const plots::HemispherePlot plot = hemisphere();
    const plots::Box disc = plot.disc(from_qt(QRectF(canvas_->rect())), widget_style());
    for (const int cell : {8 * 32 + 3, 8 * 32 + 19, 12 * 32 + 30}) {
        const double theta = head.detector.theta_centre(cell / 32);
        const double phi = head.detector.phi_centre(cell % 32);
        QTest::mouseClick(canvas_, Qt::LeftButton, {},
                          to_qt(plots::HemispherePlot::place_of(disc, theta, phi)).toPoint());
        QCOMPARE(bench_.selected_cell(), std::optional<int>(cell));
    }
    QTest::mouseClick(canvas_, Qt::LeftButton, {}, QPoint(2, 2));
    QCOMPARE(bench_.selected_cell(), std::optional<int>(12 * 32 + 30));
}

void PlotsPanelTest::selected_cell_is_outlined() {
    show_kind(PlotKind::Hemisphere);
    const QImage before = panel_->picture(kSize);
    bench_.select_cell(8 * 32 + 3);
    const QImage after = panel_->picture(kSize);
    const plots::HemispherePlot plot = hemisphere();
    const Detector& detector = bench_.drawing().layers().head->detector;
    const plots::Box disc = plot.disc(kArea, widget_style());
    const QPoint edge =
        to_qt(plots::HemispherePlot::place_of(disc, detector.theta_edge(9), detector.phi_centre(3)))
            .toPoint();
    QVERIFY(distance_near(after, edge, Qt::white) < 60);
    QVERIFY(distance_near(before, edge, Qt::white) > 60);
}

void PlotsPanelTest::read_out_shows_the_layer() {
    show_kind(PlotKind::LobeCartesian);
    const auto* label = panel_->findChild<QLabel*>("plot-read-out");
    QTest::mouseMove(canvas_, QPoint(canvas_->width() * 7 / 10, canvas_->height() / 2));
    QTRY_VERIFY_WITH_TIMEOUT(label->text().contains("Simulated"), 60000);
    const LobeSlice slice = lobe_slice(*bench_.drawing().layers().head, layer(), -1);
    const auto shown =
        std::find_if(slice.samples.begin(), slice.samples.end(), [&](const LobeSample& sample) {
            return label->text().startsWith(
                text_of("θₒ = " + plots::value_text(degrees(sample.theta_o)) + "°"));
        });
    QVERIFY2(shown != slice.samples.end(), qPrintable(label->text()));
    QVERIFY2(label->text().contains(text_of("Simulated: " + plots::value_text(shown->f) + " ± " +
                                            plots::error_text(shown->f_stderr))),
             qPrintable(label->text()));
    QTest::mouseClick(canvas_, Qt::LeftButton, {},
                      QPoint(canvas_->width() * 7 / 10, canvas_->height() / 2));
    QCOMPARE(bench_.selected_cell(), std::optional<int>(shown->cell));
}

void PlotsPanelTest::keys_move_the_cross_hair() {
    show_kind(PlotKind::LobeCartesian);
    const auto* label = panel_->findChild<QLabel*>("plot-read-out");
    canvas_->setFocus();
    QTest::keyClick(canvas_, Qt::Key_Right, Qt::ShiftModifier);
    const QString first = label->text();
    QVERIFY(!first.isEmpty());
    for (int k = 0; k < 4; ++k) QTest::keyClick(canvas_, Qt::Key_Right, Qt::ShiftModifier);
    QVERIFY(label->text() != first);
    QTest::keyClick(canvas_, Qt::Key_Return);
    QVERIFY(bench_.selected_cell().has_value());
}

void PlotsPanelTest::controls_are_steps_of_the_history() {
    auto* kind = panel_->findChild<QComboBox*>("plot-kind");
    auto* scale = panel_->findChild<QComboBox*>("plot-scale");
    auto* band = panel_->findChild<QCheckBox*>("error-band");
    QVERIFY(kind && scale && band);
    QUndoStack& history = bench_.document().undo_stack();
    const PlotView before = bench_.settings().plots;

    kind->setFocus();
    QTest::keyClick(kind, Qt::Key_End);
    QCOMPARE(bench_.settings().plots.kind, PlotKind::Normals);
    QVERIFY(!band->isEnabled());  // the count of all facets has no error
    QTest::keyClick(kind, Qt::Key_Up);
    QCOMPARE(bench_.settings().plots.kind, PlotKind::Albedo);
    QCOMPARE(history.undoText(), QString("Plot Kind"));
    QTest::mouseClick(band, Qt::LeftButton, {}, QPoint(8, band->height() / 2));
    QCOMPARE(bench_.settings().plots.error_band, !before.error_band);
    QCOMPARE(history.undoText(), QString("Error Band"));
    scale->setCurrentIndex(1 - scale->currentIndex());
    QVERIFY(bench_.settings().plots.scale != before.scale);

    history.undo();
    QCOMPARE(bench_.settings().plots.scale, before.scale);
    history.undo();
    QCOMPARE(band->isChecked(), before.error_band);
    history.undo();
    QCOMPARE(kind->currentIndex(), static_cast<int>(before.kind));
}

void PlotsPanelTest::models_follow_the_surface_or_the_slider() {
    show_kind(PlotKind::LobeCartesian);
    auto* alpha = panel_->findChild<QDoubleSpinBox*>("ggx-alpha");
    auto* slider = panel_->findChild<QSlider*>("ggx-alpha-slider");
    auto* shown = panel_->findChild<QCheckBox*>("show-ggx");
    auto* follow = panel_->findChild<QCheckBox*>("follow-surface");
    QVERIFY(alpha && slider && shown && follow);
    shown->setChecked(true);
    QVERIFY(!alpha->isEnabled());
    const double of_surface = bench_.surface().statistics().rms_gradient;
    QVERIFY(std::abs(alpha->value() - of_surface) < 1e-3);

    // The curve in the file is the library's, first of the surface's alpha, then of the slider's
    const auto model_column = [&](double width) -> QStringList {
        const QString name = "GGX α = " + QString::number(width, 'g', 3) + ": f [1/sr]";
        QStringList column;
        const auto rows = rows_of_csv(saved("models.csv"));
        const qsizetype k = rows[0].indexOf(name);
        if (k >= 0)
            for (const QStringList& row : rows) column << row[k];
        return column;
    };
    QTRY_VERIFY_WITH_TIMEOUT(!model_column(of_surface).isEmpty(), 60000);
    follow->setChecked(false);
    QVERIFY(alpha->isEnabled());
    slider->setValue(slider->maximum() / 4);
    QCOMPARE(bench_.settings().plots.overlay("ggx").alpha, 0.5);
    QTRY_VERIFY_WITH_TIMEOUT(!model_column(0.5).isEmpty(), 60000);

    MicrofacetSettings settings;
    settings.alpha_x = settings.alpha_y = 0.5;
    const LobeSlice slice =
        lobe_slice(MicrofacetBrdf(settings), *bench_.drawing().layers().head, layer(), 0);
    const QStringList column = model_column(0.5);
    for (std::size_t k = 0; k < slice.samples.size(); ++k)
        QVERIFY(column[static_cast<qsizetype>(k) + 1].toDouble() == slice.samples[k].f);
}

void PlotsPanelTest::normals_beside_the_surface() {
    show_kind(PlotKind::Normals);
    QTRY_VERIFY_WITH_TIMEOUT(rows_of_csv(saved("normals.csv")).size() > 10, 60000);
    const auto rows = rows_of_csv(saved("normals.csv"));
    const NormalProfile profile = normal_profile(*bench_.surface().surface(), 180, Run(1));
    QCOMPARE(rows[0][1], QString("surface: D [1/sr]"));
    for (std::size_t t = 0; t < profile.density.size(); ++t)
        QVERIFY(rows[static_cast<qsizetype>(t) + 1][1].toDouble() == profile.density[t]);
}

void PlotsPanelTest::another_layer_is_another_plot() {
    show_kind(PlotKind::LobePolar);
    const QImage second = panel_->picture(kSize);
    const auto look_at = [&](int number) {
        bench_.document().change("Current Layer",
                                 [&](StudioSettings& s) { s.surface_view.current_layer = number; });
        return panel_->picture(kSize);
    };
    QVERIFY(look_at(3) != second);
    QVERIFY(look_at(7) != second);  // says that there is none
    look_at(2);
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::PlotsPanelTest)
#include "plots_panel_test.moc"
