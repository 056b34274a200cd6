// SPDX-License-Identifier: Apache-2.0
// How settings, surface, drawing and paths follow each other.
#include "model/workbench.h"

#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <optional>

namespace asperity::studio {
namespace {

constexpr int kSoon = 60000;

void make_small(Workbench& bench) {
    bench.document().change("Surface Size", [](StudioSettings& s) {
        s.experiment.surface.size = 120;
        s.experiment.detector.resolution = 32;
    });
}

bool surface_comes(Workbench& bench) {
    return QTest::qWaitFor([&] { return !bench.surface().busy(); }, kSoon);
}

bool paths_come(Workbench& bench) {
    return QTest::qWaitFor([&] { return !bench.light().busy(); }, kSoon);
}

bool drawing_ends(Workbench& bench) {
    return QTest::qWaitFor([&] { return !bench.is_drawing(); }, kSoon);
}

}  // namespace

class WorkbenchTest : public QObject {
    Q_OBJECT

  private slots:
    void makes_the_surface_of_the_settings();
    void latest_surface_wins();
    void unreadable_surface();
    void draws_once_the_surface_is_ready();
    void stops_a_drawing_that_waits();
    void says_whether_layers_are_current();
    void silly_settings_are_a_complaint();
    void paths_follow();
    void paths_into_a_cell();
    void cell_is_dropped();
    void ends_at_once();
    void logs();
};

void WorkbenchTest::makes_the_surface_of_the_settings() {
    Workbench bench;
    QVERIFY(bench.surface().busy());
    QVERIFY(surface_comes(bench));
    QCOMPARE(bench.surface().surface()->nx, 512);
    QVERIFY(bench.surface().statistics().rms_height > 0);

    QSignalSpy started(&bench.surface(), &SurfaceSource::started);
    const auto old = bench.surface().surface();
    bench.document().change("Surface Roughness",
                            [](StudioSettings& s) { s.experiment.surface.roughness = 0; });
    QCOMPARE(started.count(), 1);
    QCOMPARE(bench.surface().surface(), old);  // stays until the new one is ready
    QVERIFY(surface_comes(bench));
    QCOMPARE(bench.surface().statistics().rms_height, 0.0);
    QVERIFY(bench.surface().surface() != old);
    QCOMPARE(bench.surface().settings().roughness, 0.0);

    bench.document().undo_stack().undo();
    QVERIFY(surface_comes(bench));
    QCOMPARE(bench.surface().surface()->heights, old->heights);

    // What does not decide the surface does not make it anew
    bench.document().change("Ray Bounces", [](StudioSettings& s) { s.experiment.run.bounces = 2; });
    QVERIFY(!bench.surface().busy());
}

void WorkbenchTest::latest_surface_wins() {
    Workbench bench;
    QSignalSpy ready(&bench.surface(), &SurfaceSource::ready);
    for (int size = 130; size <= 200; size += 10)
        bench.document().change("Surface Size",
                                [size](StudioSettings& s) { s.experiment.surface.size = size; });
    QVERIFY(surface_comes(bench));
    QCOMPARE(bench.surface().surface()->nx, 200);
    QCOMPARE(ready.count(), 1);
}

void WorkbenchTest::unreadable_surface() {
    Workbench bench;
    QVERIFY(surface_comes(bench));
    const auto old = bench.surface().surface();
    QSignalSpy complaint(&bench, &Workbench::complaint);
    bench.document().change("Surface", [](StudioSettings& s) {
        s.experiment.surface.kind = kSurfaceFile;
        s.experiment.surface.file = "/no/such/heights.gsf";
    });
    bench.draw_to_textures();
    QVERIFY(bench.is_drawing());
    QVERIFY(complaint.wait(kSoon));
    QCOMPARE(complaint.front().front().toString(),
             "/no/such/heights.gsf: cannot open: No such file or directory");
    QVERIFY(!bench.is_drawing());
    QCOMPARE(bench.surface().surface(), old);
    QCOMPARE(bench.log_lines().size(), 1);

    // The older surface is still to be seen, but not drawn in place of the one asked for
    bench.draw_to_textures();
    QVERIFY(complaint.wait(kSoon));
    QVERIFY(!bench.is_drawing());
    QVERIFY(bench.drawing().layers().head == nullptr);
}

void WorkbenchTest::draws_once_the_surface_is_ready() {
    Workbench bench;
    make_small(bench);
    QSignalSpy changed(&bench, &Workbench::drawing_changed);
    bench.draw_to_textures();
    QVERIFY(bench.is_drawing());
    QCOMPARE(changed.count(), 1);
    QVERIFY(bench.surface().busy());
    QVERIFY(drawing_ends(bench));
    QCOMPARE(bench.drawing().result()->surface_nx, 120);
    QCOMPARE(bench.drawing().layers().by_number.size(), 15U);
}

void WorkbenchTest::stops_a_drawing_that_waits() {
    Workbench bench;
    bench.draw_to_textures();
    bench.stop_drawing();
    QVERIFY(!bench.is_drawing());
    QVERIFY(surface_comes(bench));
    QCOMPARE(bench.drawing().state(), Drawing::State::Idle);
    QVERIFY(bench.drawing().layers().head == nullptr);
}

void WorkbenchTest::says_whether_layers_are_current() {
    Workbench bench;
    make_small(bench);
    QVERIFY(!bench.are_layers_current());
    bench.draw_to_textures();
    QVERIFY(drawing_ends(bench));
    QVERIFY(bench.are_layers_current());
    bench.document().change("Current Layer",
                            [](StudioSettings& s) { s.surface_view.current_layer = 3; });
    QVERIFY(bench.are_layers_current());
    bench.document().change("Ray Bounces", [](StudioSettings& s) { s.experiment.run.bounces = 2; });
    QVERIFY(!bench.are_layers_current());
    QVERIFY(bench.drawing().layers().complete);  // they stay all the same
    bench.document().undo_stack().undo();
    QVERIFY(bench.are_layers_current());
}

void WorkbenchTest::silly_settings_are_a_complaint() {
    Workbench bench;
    make_small(bench);
    QVERIFY(surface_comes(bench));
    QSignalSpy complaint(&bench, &Workbench::complaint);
    bench.document().change("Optics", [](StudioSettings& s) {
        s.experiment.optics.fresnel = FresnelKind::Dielectric;
        s.experiment.optics.ior = {};
    });
    bench.draw_to_textures();
    QCOMPARE(complaint.count(), 1);
    QVERIFY(complaint.front().front().toString().startsWith("ior: "));
    QVERIFY(!bench.is_drawing());
}

void WorkbenchTest::paths_follow() {
    Workbench bench;
    make_small(bench);
    QVERIFY(surface_comes(bench));
    QVERIFY(bench.light().paths().empty() && !bench.light().busy());

    bench.document().change("Paths", [](StudioSettings& s) {
        s.surface_view.paths = true;
        s.surface_view.path_count = 50;
    });
    QVERIFY(bench.light().busy());
    QVERIFY(paths_come(bench));
    QCOMPARE(bench.light().paths().size(), 50U);
    QCOMPARE(bench.light().wish()->layer, 15);

    bench.document().change("Current Layer",
                            [](StudioSettings& s) { s.surface_view.current_layer = 4; });
    QVERIFY(paths_come(bench));
    QCOMPARE(bench.light().wish()->layer, 4);

    // Another surface: paths over that
    bench.document().change("Surface Roughness",
                            [](StudioSettings& s) { s.experiment.surface.roughness = 0; });
    QVERIFY(surface_comes(bench));
    QVERIFY(paths_come(bench));
    QCOMPARE(bench.light().wish()->surface, bench.surface().surface());

    bench.document().change("Paths", [](StudioSettings& s) { s.surface_view.paths = false; });
    QVERIFY(bench.light().paths().empty());
}

void WorkbenchTest::paths_into_a_cell() {
    Workbench bench;
    make_small(bench);
    bench.document().change("Paths", [](StudioSettings& s) {
        s.surface_view.paths = true;
        s.surface_view.path_count = 20;
        s.surface_view.current_layer = 9;
    });
    bench.draw_to_textures();
    QVERIFY(drawing_ends(bench));
    const auto all_in_cell_40 = [&] {
        const auto& paths = bench.light().paths();
        return std::all_of(paths.begin(), paths.end(), [](auto& path) { return path.cell == 40; });
    };
    QVERIFY(paths_come(bench));
    QVERIFY(!all_in_cell_40());
    bench.select_cell(40);
    QVERIFY(paths_come(bench));
    QCOMPARE(bench.light().paths().size(), 20U);
    QVERIFY(all_in_cell_40());

    // The layers shown have cells of their own, though the settings say other ones already
    bench.document().change("Texture Resolution",
                            [](StudioSettings& s) { s.experiment.detector.resolution = 512; });
    bench.select_cell(40);
    QVERIFY(paths_come(bench));
    QCOMPARE(bench.light().wish()->experiment.detector.resolution, 32);
    QVERIFY(all_in_cell_40());

    bench.select_cell(std::nullopt);
    QVERIFY(paths_come(bench));
    QVERIFY(!all_in_cell_40());
}

void WorkbenchTest::cell_is_dropped() {
    Workbench bench;
    make_small(bench);
    QSignalSpy selected(&bench, &Workbench::cell_selected);
    bench.select_cell(17);
    bench.select_cell(17);
    QCOMPARE(selected.count(), 1);
    QCOMPARE(bench.selected_cell(), std::optional<int>(17));
    bench.document().change("Texture Resolution",
                            [](StudioSettings& s) { s.experiment.detector.resolution = 64; });
    QCOMPARE(bench.selected_cell(), std::nullopt);

    bench.select_cell(5);
    bench.draw_to_textures();
    QVERIFY(drawing_ends(bench));
    QCOMPARE(bench.selected_cell(), std::nullopt);
}

void WorkbenchTest::ends_at_once() {
    std::optional<Workbench> bench(std::in_place);
    make_small(*bench);
    bench->document().change("Camera Jitter",
                             [](StudioSettings& s) { s.experiment.run.jitter = 1e5; });
    bench->document().change("Paths", [](StudioSettings& s) { s.surface_view.paths = true; });
    bench->draw_to_textures();
    QVERIFY(QTest::qWaitFor([&] { return !bench->drawing().layers().by_number.empty(); }, kSoon));
    bench->document().change("Surface Size",
                             [](StudioSettings& s) { s.experiment.surface.size = 8192; });
    QTest::qWait(50);
    QElapsedTimer timer;
    timer.start();
    bench.reset();
    qInfo("ending while drawing and making a surface: %lld ms", timer.elapsed());
    QVERIFY(timer.elapsed() < 1000);
}

void WorkbenchTest::logs() {
    Workbench bench;
    QSignalSpy logged(&bench, &Workbench::logged);
    bench.log("Frame Stats: 200 FPS (5.00 ms/frame)");
    QCOMPARE(logged.count(), 1);
    QCOMPARE(bench.log_lines(), QStringList("Frame Stats: 200 FPS (5.00 ms/frame)"));
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::WorkbenchTest)
#include "workbench_test.moc"
