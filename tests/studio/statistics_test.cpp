// SPDX-License-Identifier: Apache-2.0
// The Statistics of the thesis, figures 2.6 - 2.8, line by line.
#include "model/statistics_text.h"

#include <asperity/core/run.h>
#include <asperity/surface/make_surface.h>

#include <QSignalSpy>
#include <QTest>

namespace asperity::studio {
namespace {

Heightfield surface_of_size(int size) {
    SurfaceSettings settings;
    settings.size = size;
    Run run;
    return make_surface(settings, run);
}

}  // namespace

class StatisticsTest : public QObject {
    Q_OBJECT

  private slots:
    void figure_2_6();
    void figure_2_8b();
    void rays_of_a_drawing();
};

void StatisticsTest::figure_2_6() {
    const GeometryCounts small = geometry_of(surface_of_size(120));
    QCOMPARE(small.meshes, 14400U);
    QCOMPARE(small.transform_matrices(), 14401U);
    QCOMPARE(small.unique_triangles, 28800U);
    QCOMPARE(small.unique_vertices, 57600U);
    QCOMPARE(geometry_of(surface_of_size(512)).unique_triangles, 524288U);
}

void StatisticsTest::figure_2_8b() {
    StudioStatistics s;
    s.frames_per_second = 200;
    s.milliseconds_per_frame = 5;
    s.geometry = geometry_of(surface_of_size(512));
    s.resolution = 512;
    s.rays = {1048576, 2.5e7};
    QCOMPARE(statistics_text(s), QStringLiteral(R"(Frame Stats: 200 FPS (5.00 ms/frame)

Geometry stats:
  Mesh count: 262144
  Mesh instance count (total): 262144
  Mesh instance count (opaque): 262144
  Mesh instance count (non-opaque): 0
  Transform matrix count: 262145
  Unique triangle count: 524288
  Unique vertex count: 1048576
  Instanced triangle count: 524288
  Instanced vertex count: 1048576

Environment map:
  Resolution: 512x512

Rays Stats:
  Rays Count: 1.04858e+06
  Rays/s: 2.5e+07)"));
}

void StatisticsTest::rays_of_a_drawing() {
    Drawing drawing;
    QCOMPARE(rays_of(drawing).rays, 0.0);
    Experiment experiment;
    experiment.surface.size = 120;
    experiment.detector.resolution = 32;
    experiment.run.jitter = 2;
    QSignalSpy completed(&drawing, &Drawing::completed);
    drawing.start(std::make_shared<Heightfield>(surface_of_size(120)), experiment);
    QVERIFY(completed.wait(60000));
    QCOMPARE(rays_of(drawing).rays, 432000.0);  // figure 2.6: 2 rays a cell, 15 layers
    QVERIFY(rays_of(drawing).per_second > 0);
    drawing.clear();
    QCOMPARE(rays_of(drawing).rays, 0.0);
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::StatisticsTest)
#include "statistics_test.moc"
