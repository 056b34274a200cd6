// SPDX-License-Identifier: Apache-2.0
#include "studio_window.h"

#include "view/model_scene.h"
#include "view/statistics_panel.h"
#include "view/surface_scene.h"

#include <QLabel>

#include <cmath>
#include <cstdlib>

namespace asperity::studio::testing {

namespace {

constexpr int kSoon = 60000;

}  // namespace

QString StudioWindow::text(const char* label) {
    if (qstrcmp(label, "statistics-text") == 0) control<StatisticsPanel>("statistics").refresh();
    return control<QLabel>(label).text();
}

bool StudioWindow::surface_comes() {
    return QTest::qWaitFor([this] { return !workbench().surface().busy(); }, kSoon);
}

bool StudioWindow::draw() {
    click("draw-to-textures");
    return QTest::qWaitFor([this] { return !workbench().is_drawing(); }, kSoon) &&
           workbench().drawing().result() != nullptr;
}

bool StudioWindow::picture_comes() {
    // Changes of settings reach the picture by way of timers and threads
    constexpr int kOnTheWayMs = 250;
    QTest::qWait(kOnTheWayMs);
    Viewport& shown = viewport();
    int first_passes = 0;
    const auto connection = QObject::connect(&shown, &Viewport::frame_shown, this, [&] {
        if (!shown.frame().moving && shown.frame().passes == 1) ++first_passes;
    });
    // The first picture that comes may be of the wish before; the second is not. On a busy machine
    // a first pass may be overtaken by the second before it is shown: ask again then
    constexpr int kPatienceMs = 2000;
    for (int wish = 0; first_passes < 2 && wish < kSoon / kPatienceMs; ++wish) {
        const int before = first_passes;
        shown.refresh();
        static_cast<void>(QTest::qWaitFor([&] { return first_passes > before; }, kPatienceMs));
    }
    QObject::disconnect(connection);
    return first_passes >= 2 && shown.frame().image.size() == shown.frame().full;
}

Viewport& StudioWindow::viewport() {
    const bool surface = workbench().settings().scene == SceneKind::Surface;
    return surface ? surface_scene().viewport() : model_scene().viewport();
}

QImage StudioWindow::picture() {
    return viewport().grab_picture().convertToFormat(QImage::Format_RGB32);
}

void StudioWindow::set_small() {
    workbench().document().change("Test", [](StudioSettings& s) {
        s.experiment.surface.size = 120;
        s.experiment.detector.resolution = 64;
        s.experiment.run.jitter = 1;
        s.experiment.run.bounces = 4;
    });
}

double difference(const QImage& a, const QImage& b) {
    if (a.size() != b.size() || a.isNull()) return 1;
    constexpr int kShades = 6;
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            if (std::abs(qRed(p) - qRed(q)) > kShades ||
                std::abs(qGreen(p) - qGreen(q)) > kShades ||
                std::abs(qBlue(p) - qBlue(q)) > kShades)
                ++count;
        }
    return static_cast<double>(count) / (a.width() * a.height());
}

}  // namespace asperity::studio::testing
