// SPDX-License-Identifier: Apache-2.0
// How long the window takes to be there at the first start, and
// frame times of both scenes by the program's own counter, at 1920 x 1080, while the camera is
// dragged round and after it stopped: a surface of 512 x 512 samples, and a model, a file if one is
// named. Prints, judges nothing.
#include "model/first_session.h"
#include "view/main_window.h"
#include "view/model_scene.h"
#include "view/surface_scene.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTimer>

#include <fmt/format.h>

#include <ctime>

using namespace asperity;
using namespace asperity::studio;

namespace {

const QSize kSize(1920, 1080);

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void send(Viewport& view, QEvent::Type type, QPointF at, Qt::MouseButtons buttons) {
    const bool move = type == QEvent::MouseMove;
    QMouseEvent event(type, at, view.mapToGlobal(at), move ? Qt::NoButton : Qt::LeftButton, buttons,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(&view, &event);
}

/// Sleeps between events, as the program does: what spins takes a core away from the picture.
void run_until(const std::function<bool()>& done) {
    QTimer waker;
    waker.start(10);
    while (!done()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

/// Drags for some seconds and says how fluid that was.
void measure(Viewport& view, const char* name) {
    constexpr qint64 kMilliseconds = 3000;
    int frames = 0;
    double pixels = 0;
    const auto counting = QObject::connect(&view, &Viewport::frame_shown, [&] {
        if (!view.frame().moving) return;
        ++frames;
        pixels += double(view.frame().image.width()) * view.frame().image.height();
    });
    QElapsedTimer clock;
    clock.start();
    const double cpu = cpu_seconds();
    send(view, QEvent::MouseButtonPress, {640, 300}, Qt::LeftButton);
    double fps = 0, ms = 0;
    QTimer mouse;
    QObject::connect(&mouse, &QTimer::timeout, [&] {
        const double t = 1e-3 * static_cast<double>(clock.elapsed());
        send(view, QEvent::MouseMove, {640 + 200 * t, 300 + 60 * std::sin(3 * t)}, Qt::LeftButton);
        if (!view.frame().moving) return;
        fps = view.painter().frames_per_second();
        ms = view.painter().milliseconds_per_frame();
    });
    mouse.start(8);
    run_until([&] { return clock.elapsed() > kMilliseconds; });
    mouse.stop();
    const double cpu_moving = cpu_seconds() - cpu;
    QObject::disconnect(counting);
    clock.restart();
    const double cpu_before = cpu_seconds();
    send(view, QEvent::MouseButtonRelease, {1200, 300}, Qt::NoButton);
    run_until([&] { return !view.frame().moving && view.frame().passes >= 1; });
    const double still = 1e-3 * double(clock.elapsed()), cpu_still = cpu_seconds() - cpu_before;
    fmt::print(
        "{:<28} {:5.1f} frames/s, {:5.1f} ms a frame of {:.0f} % of the pixels, {:.0f} ms CPU a "
        "frame; full picture {:.3f} s after the stop ({:.3f} s CPU)\n",
        name, fps, ms, 100 * pixels / std::max(1, frames) / (view.width() * view.height()),
        1000 * cpu_moving / std::max(1, frames), still, cpu_still);
}

/// Tells when a widget is first painted.
class FirstPaint : public QObject {
  public:
    explicit FirstPaint(QWidget& widget) { widget.installEventFilter(this); }
    bool is_there() const { return there_; }
    bool eventFilter(QObject*, QEvent* event) override {
        there_ = there_ || event->type() == QEvent::Paint;
        return false;
    }

  private:
    bool there_ = false;
};

/// As asperity-studio starts, from the beginning of its main function on.
void measure_window() {
    QElapsedTimer clock;
    clock.start();
    MainWindow window;
    FirstPaint paint(window);
    bool pictured = false;
    for (Viewport* view : window.findChildren<Viewport*>())
        QObject::connect(view, &Viewport::frame_shown,
                         [&] { pictured = bool(window.workbench().surface().surface()); });
    window.begin(true);
    window.resize(kSize);
    window.show();
    run_until([&] { return paint.is_there(); });
    const double painted = 1e-3 * double(clock.elapsed());
    run_until([&] { return pictured; });
    fmt::print("first start: window {:.2f} s, the surface in it {:.2f} s\n", painted,
               1e-3 * double(clock.elapsed()));
}

using Edit = std::function<void(StudioSettings&)>;

void wait(int milliseconds) {
    QElapsedTimer clock;
    clock.start();
    run_until([&] { return clock.elapsed() > milliseconds; });
}

void measure_surface(Workbench& bench) {
    SurfaceScene scene(bench);
    scene.resize(kSize);
    scene.show();
    const auto after = [&](const char* name, const Edit& edit) {
        bench.document().change("Frames", edit);
        run_until([&] { return bench.surface().surface() && !bench.surface().busy(); });
        run_until([&] { return !bench.is_drawing() && !bench.light().busy(); });
        wait(300);
        measure(scene.viewport(), name);
    };
    after("roughness 1, nothing drawn",
          [](StudioSettings& s) { s.experiment.surface.roughness = 1; });
    bench.draw_to_textures();
    after("roughness 1, in its dome", [](StudioSettings&) {});
    after("the same, lit", [](StudioSettings& s) { s.surface_view.shading = SurfaceShading::Lit; });
    after("dome and lobe", [](StudioSettings& s) { s.surface_view.lobe = true; });
    after("and with 200 paths of light", [](StudioSettings& s) { s.surface_view.paths = true; });
}

void measure_model(Workbench& bench, const QString& model, bool only_first) {
    studio::ModelScene scene(bench);
    scene.resize(kSize);
    scene.show();
    scene.load(model);
    if (only_first) {
        bench.document().change(
            "First", [](StudioSettings& s) { s.experiment = first_session().experiment; });
        bench.draw_to_textures();
        run_until([&] { return !bench.is_drawing(); });
    }
    const auto after = [&](const char* name, const Edit& edit) {
        bench.document().change("Frames", edit);
        run_until([&] { return scene.has_model() && scene.is_settled(); });
        wait(300);
        measure(scene.viewport(), name);
    };
    if (!only_first) {
        after("model, Cook-Torrance", [](StudioSettings& s) { s.model_view.brdf_runs = true; });
        after("model, simulated",
              [](StudioSettings& s) { s.model_view.brdf.type = BrdfType::Simulated; });
        after("model, split", [](StudioSettings& s) {
            s.model_view.compare = true;
            s.model_view.second.type = BrdfType::Model;
        });
        after("model, split, under the sky",
              [](StudioSettings& s) { s.model_view.light = LightKind::Sky; });
    }
    after("model of the first session", [&model](StudioSettings& s) {
        s.model_view = first_session().model_view;
        s.model_view.model = model.toStdString();
    });
}

}  // namespace

int main(int argc, char** argv) {
    const QApplication application(argc, argv);
    if (argc == 1) measure_window();
    Workbench bench;
    if (argc <= 2) measure_surface(bench);
    measure_model(bench, argc > 1 ? QString::fromLocal8Bit(argv[1]) : QString("knot"), argc > 2);
    return 0;
}
