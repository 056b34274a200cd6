// SPDX-License-Identifier: Apache-2.0
// Pictures of the program, as the figures of thesis section 2, for the README and the user guide.
// They go into the folder ASPERITY_SCREENSHOTS, else screenshots/ where the test runs; none may be
// empty. A model file ASPERITY_BUNNY takes the place of the built-in ball.
#include "studio_window.h"

#include "view/model_scene.h"
#include "view/plots_panel.h"
#include "view/run_test_dialog.h"
#include "view/surface_scene.h"
#include "view/theme.h"
#include "view/tour.h"

#include <asperity/bsdf/bsdf_models.h>

#include <QDir>
#include <QDockWidget>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace asperity::studio::testing {

namespace {

/// How many different colours there are, 4 bits a channel.
std::size_t colours_of(const QImage& image) {
    std::set<QRgb> colours;
    for (int y = 0; y < image.height(); y += 2)
        for (int x = 0; x < image.width(); x += 2) colours.insert(image.pixel(x, y) & 0xf0f0f0);
    return colours.size();
}

/// Share of the pixels that are not of the commonest colour.
double drawn_share(const QImage& image) {
    std::map<QRgb, int> counts;
    int most = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) most = std::max(most, ++counts[image.pixel(x, y)]);
    return 1 - static_cast<double>(most) / (image.width() * image.height());
}

}  // namespace

class ScreenshotsTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase();
    void cleanup() { window_.reset(); }

    void figure_2_2();
    void figure_2_5();
    void figure_2_10_and_2_11();
    void figure_2_12();
    void figure_2_13();
    void figures_2_17_to_2_19();
    void figures_2_20_and_2_21();
    void seeing_the_light();
    void plots();
    void tour();
    void light_theme();

  private:
    void open(Theme theme = Theme::Dark, QSize size = {1600, 940});
    void edit(const std::function<void(StudioSettings&)>& change);
    void draw();
    void show_model();
    /// Saves the whole window, or one widget of it, and looks whether there is something in it.
    void shoot(const QString& name, QWidget* widget = nullptr, double least_drawn = 0.05);
    StudioWindow& window() { return *window_; }

    TestScope scope_;
    QDir folder_;
    std::unique_ptr<StudioWindow> window_;
};

void ScreenshotsTest::initTestCase() {
    folder_.setPath(qEnvironmentVariable("ASPERITY_SCREENSHOTS", "screenshots"));
    QVERIFY(folder_.mkpath("."));
}

void ScreenshotsTest::open(Theme theme, QSize size) {
    apply_theme(theme);
    window_ = std::make_unique<StudioWindow>(size);
    edit([](StudioSettings& s) {
        s.experiment.surface.size = 128;
        s.experiment.surface.roughness = 0.1;
        s.experiment.detector.resolution = 128;
        s.experiment.run.jitter = 4;
    });
    QVERIFY(window().surface_comes());
    QVERIFY(window().picture_comes());
}

void ScreenshotsTest::edit(const std::function<void(StudioSettings&)>& change) {
    window().workbench().document().change("Screenshot", change);
}

void ScreenshotsTest::draw() {
    window().workbench().draw_to_textures();
    QVERIFY(QTest::qWaitFor([this] { return !window().workbench().is_drawing(); }, 120000));
    QVERIFY(window().picture_comes());
}

void ScreenshotsTest::show_model() {
    window().load_model(qEnvironmentVariable("ASPERITY_BUNNY", "ball"));
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 60000));
    QVERIFY(window().picture_comes());
}

void ScreenshotsTest::shoot(const QString& name, QWidget* widget, double least_drawn) {
    QTest::qWait(400);  // plots and statistics follow by timers
    // Smooth edges if the machine finds the time
    static_cast<void>(
        QTest::qWaitFor([this] { return window().viewport().frame().passes >= 8; }, 4000));
    const QImage image =
        (widget ? widget : window_.get())->grab().toImage().convertToFormat(QImage::Format_RGB32);
    QVERIFY(image.save(folder_.filePath(name + ".png")));
    const double drawn = drawn_share(image);
    QVERIFY2(drawn > least_drawn, qPrintable(QString("%1: %2 drawn").arg(name).arg(drawn)));
    QVERIFY2(colours_of(image) > 12, qPrintable(name));
}

void ScreenshotsTest::figure_2_2() {
    open();
    edit([](StudioSettings& s) { s.experiment.surface.roughness = 0; });
    QVERIFY(window().surface_comes());
    QVERIFY(window().picture_comes());
    shoot("figure-2-2a-window");
    shoot("figure-2-2b-menu", window().findChild<QDockWidget*>("menu-dock"));
}

void ScreenshotsTest::figure_2_5() {
    open();
    for (const double roughness : {0.0, 1.0}) {
        edit([roughness](StudioSettings& s) {
            s.experiment.surface.roughness = roughness;
            s.surface_view.beam = false;
        });
        QVERIFY(window().surface_comes());
        QVERIFY(window().picture_comes());
        shoot(roughness == 0 ? "figure-2-5a-smooth" : "figure-2-5b-rough",
              &window().surface_scene(), 0.01);
    }
}

void ScreenshotsTest::figure_2_10_and_2_11() {
    open();
    edit([](StudioSettings& s) {
        s.experiment.surface.roughness = 1;
        s.surface_view.paths = true;
        s.surface_view.path_count = 40;
        s.surface_view.current_layer = 12;
    });
    for (const int bounces : {1, 10}) {
        edit([bounces](StudioSettings& s) { s.experiment.run.bounces = bounces; });
        QVERIFY(window().surface_comes());
        QVERIFY(QTest::qWaitFor([this] { return !window().workbench().light().busy(); }, 30000));
        draw();
        shoot(bounces == 1 ? "figure-2-11a-few-bounces" : "figure-2-11b-ten-bounces",
              &window().surface_scene());
    }
}

void ScreenshotsTest::figure_2_12() {
    open();
    draw();
    for (const int layer : {1, 15}) {
        edit([layer](StudioSettings& s) { s.surface_view.current_layer = layer; });
        QVERIFY(window().picture_comes());
        shoot(layer == 1 ? "figure-2-12a-layer-1" : "figure-2-12b-layer-15");
    }
}

void ScreenshotsTest::figure_2_13() {
    open();
    window().run_test();
    auto* dialog = window().findChild<RunTestDialog*>();
    QVERIFY(QTest::qWaitFor([&] { return !dialog->busy(); }, 120000));
    shoot("figure-2-13a-run-test", dialog);
    dialog->close();
    show_model();
    shoot("figure-2-13c-model");
}

void ScreenshotsTest::figures_2_17_to_2_19() {
    open();
    show_model();
    edit([](StudioSettings& s) { s.model_view.brdf_runs = true; });
    const auto look = [this](const char* name, SpecSettings settings) {
        edit([&](StudioSettings& s) {
            s.model_view.brdf.settings["cook-torrance"] = std::move(settings);
        });
        QVERIFY(window().picture_comes());
        shoot(name, &window().model_scene());
    };
    look("figure-2-17a-not-metallic", {{"roughness", "0.4"}, {"metallic", "0"}});
    look("figure-2-17b-metallic", {{"roughness", "0.4"}});
    look("figure-2-18a-smooth", {{"roughness", "0.2"}});
    look("figure-2-18b-rough", {{"roughness", "0.7"}});
    look("figure-2-19-colour",
         {{"roughness", "0.7"}, {"metallic", "0"}, {"albedo", "0.9/0.25/0.2"}});
}

void ScreenshotsTest::figures_2_20_and_2_21() {
    open();
    edit([](StudioSettings& s) {
        s.experiment.surface.kind = "gaussian";
        s.experiment.surface.size = 512;
        s.experiment.surface.alpha_x = s.experiment.surface.alpha_y = 0.2;
        s.experiment.detector.resolution = 256;
        s.experiment.illumination.isotropic = true;
    });
    QVERIFY(window().surface_comes());
    draw();
    for (const int layer : {1, 15}) {
        edit([layer](StudioSettings& s) { s.surface_view.current_layer = layer; });
        QVERIFY(window().picture_comes());
        shoot(layer == 1 ? "figure-2-20-layer-1" : "figure-2-20-layer-15");
    }

    show_model();
    edit([](StudioSettings& s) {
        s.model_view.brdf_runs = true;
        s.model_view.brdf.type = BrdfType::Simulated;
        s.model_view.brdf.settings["cook-torrance"] = {{"roughness", "0.447"}};
    });
    QTest::qWait(1500);  // the layers are made a material in the background
    QVERIFY(window().picture_comes());
    shoot("figure-2-21-simulated");
    edit([](StudioSettings& s) { s.model_view.brdf.type = BrdfType::Model; });
    QVERIFY(window().picture_comes());
    shoot("figure-2-21-cook-torrance");
    edit([](StudioSettings& s) {
        s.model_view.compare = true;
        s.model_view.second.type = BrdfType::Simulated;
    });
    QTest::qWait(1500);
    QVERIFY(window().picture_comes());
    shoot("split-view");
}

void ScreenshotsTest::seeing_the_light() {
    open();
    edit([](StudioSettings& s) {
        s.experiment.surface.kind = "gaussian";
        s.experiment.surface.correlation_x = s.experiment.surface.correlation_y = 10;
        s.experiment.surface.alpha_x = s.experiment.surface.alpha_y = 0.4;
        s.surface_view.shading = SurfaceShading::Lit;
        s.surface_view.sky_map.colour_map = io::ColourMap::Inferno;
        s.surface_view.current_layer = 9;
        s.surface_view.paths = true;
    });
    QVERIFY(window().surface_comes());
    draw();
    QVERIFY(QTest::qWaitFor([this] { return !window().workbench().light().busy(); }, 30000));
    shoot("seeing-the-light");
}

void ScreenshotsTest::plots() {
    open();
    edit([](StudioSettings& s) {
        s.experiment.surface.kind = "gaussian";
        s.experiment.surface.size = 256;
        s.surface_view.current_layer = 9;
        s.plots.overlays["ggx"].shown = s.plots.overlays["beckmann"].shown = true;
    });
    QVERIFY(window().surface_comes());
    draw();
    const std::pair<PlotKind, const char*> kinds[] = {
        {PlotKind::LobePolar, "plot-lobe-polar"},
        {PlotKind::LobeCartesian, "plot-lobe-cartesian"},
        {PlotKind::Hemisphere, "plot-hemisphere"},
        {PlotKind::Albedo, "plot-albedo"},
        {PlotKind::Normals, "plot-normals"}};
    for (const auto& [kind, name] : kinds) {
        edit([kind = kind](StudioSettings& s) { s.plots.kind = kind; });
        QTest::qWait(1500);
        shoot(name, &window().plots());
    }
}

void ScreenshotsTest::tour() {
    open();
    window().tour().begin();
    for (int step = 0; step < Tour::step_count(); ++step) {
        if (step > 0)
            QTest::mouseClick(&window().control<QPushButton>("tour-next"), Qt::LeftButton);
        QCOMPARE(window().tour().step(), step);
        QVERIFY(QTest::qWaitFor([this] { return !window().workbench().is_drawing(); }, 120000));
        QVERIFY(window().workbench().are_layers_current());
        QVERIFY(QTest::qWaitFor([this] { return !window().workbench().light().busy(); }, 30000));
        QVERIFY(window().picture_comes());
        QTest::qWait(1000);
        shoot(QString("tour-%1").arg(step + 1));
    }
}

void ScreenshotsTest::light_theme() {
    open(Theme::Light);
    draw();
    shoot("light-surface");
    show_model();
    edit([](StudioSettings& s) { s.model_view.brdf_runs = true; });
    QVERIFY(window().picture_comes());
    shoot("light-model");
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::ScreenshotsTest)
#include "screenshots_test.moc"
