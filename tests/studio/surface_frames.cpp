// SPDX-License-Identifier: Apache-2.0
// Frame times of the surface scene by the program's own counter: 512 x 512 samples at 1280 x 720,
// while the camera is dragged round and after it stopped. Prints, judges nothing.
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

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void send(Viewport& view, QEvent::Type type, QPointF at, Qt::MouseButtons buttons) {
    const bool move = type == QEvent::MouseMove;
    QMouseEvent event(type, at, view.mapToGlobal(at), move ? Qt::NoButton : Qt::LeftButton, buttons,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(&view, &event);
}

void run_until(const std::function<bool()>& done) {
    while (!done()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 50);
}

/// Drags for some seconds and says how fluid that was.
void measure(SurfaceScene& scene, const char* name) {
    Viewport& view = scene.viewport();
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
    run_until([&] { return view.frame().passes >= kSurfaceSamples; });
    fmt::print(
        "{:<28} {:5.1f} frames/s, {:5.1f} ms a frame of {:.0f} % of the pixels, {:.0f} ms CPU a "
        "frame; full picture {:.3f} s after the stop ({:.3f} s CPU), smooth after {:.2f} s\n",
        name, fps, ms, 100 * pixels / std::max(1, frames) / (view.width() * view.height()),
        1000 * cpu_moving / std::max(1, frames), still, cpu_still, 1e-3 * double(clock.elapsed()));
}

}  // namespace

int main(int argc, char** argv) {
    const QApplication application(argc, argv);
    Workbench bench;
    const auto change = [&bench](const std::function<void(StudioSettings&)>& edit) {
        bench.document().change("Frames", edit);
    };
    SurfaceScene scene(bench);
    scene.resize(1280, 720);
    scene.show();
    const auto settle = [&] {
        run_until([&] { return bench.surface().surface() && !bench.surface().busy(); });
        run_until([&] { return !bench.is_drawing() && !bench.light().busy(); });
        QElapsedTimer clock;
        clock.start();
        run_until([&] { return clock.elapsed() > 300; });
    };
    change([](StudioSettings& s) { s.experiment.surface.roughness = 1; });
    settle();
    measure(scene, "roughness 1, nothing drawn");
    bench.draw_to_textures();
    settle();
    measure(scene, "roughness 1, in its dome");
    change([](StudioSettings& s) { s.surface_view.shading = SurfaceShading::Lit; });
    settle();
    measure(scene, "the same, lit");
    change([](StudioSettings& s) { s.surface_view.paths = true; });
    settle();
    measure(scene, "and with 200 paths of light");
    return 0;
}
