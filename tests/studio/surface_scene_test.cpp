// SPDX-License-Identifier: Apache-2.0
// The scene "Microfacets Surface" as its users see it: by its pixels, clicks and labels.
#include "view/surface_scene.h"
#include "view/beam_overlay.h"
#include "view/dome_overlay.h"
#include "view/paths_overlay.h"
#include "view/surface_labels.h"

#include <asperity/core/directions.h>

#include <QSignalSpy>
#include <QTest>

#include <cmath>

namespace asperity::studio {

class SurfaceSceneTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup();

    void roughness_zero_is_pure_green_in_red_lines();
    void mirror_direction_is_where_its_cell_is();
    void surface_and_ground_are_no_cells();
    void click_selects_and_gives_up();
    void drawn_layer_lights_the_dome();
    void readings_tell_what_was_measured();
    void layer_changes_the_beam();
    void jitter_shows_copies_of_the_beam();
    void paths_lead_from_the_light_to_their_cell();
    void paths_of_a_cell_light_their_facets();
    void camera_type_follows_the_settings();
    void empty_scene_without_extras();

  private:
    void change(const std::function<void(StudioSettings&)>& edit);
    void wait_for_surface();
    void wait_for_picture();
    void draw();
    Viewport& view() { return scene_->viewport(); }
    /// Pixels of the scene, lines and all, that fulfil `wanted`.
    int count(const std::function<bool(QColor)>& wanted);
    QPointF place_of(double theta, double phi);

    std::unique_ptr<Workbench> bench_;
    std::unique_ptr<SurfaceScene> scene_;
};

void SurfaceSceneTest::init() {
    bench_ = std::make_unique<Workbench>();
    change([](StudioSettings& s) {
        s.experiment.surface.size = 32;
        s.experiment.surface.roughness = 0;
        s.experiment.illumination.layers = 3;
        s.experiment.detector.resolution = 32;
        s.experiment.run.rays = 20000;
        s.surface_view.current_layer = 1;
    });
    scene_ = std::make_unique<SurfaceScene>(*bench_);
    scene_->resize(480, 270);
    scene_->show();
    QVERIFY(QTest::qWaitForWindowExposed(scene_.get()));
    wait_for_surface();
    wait_for_picture();
}

void SurfaceSceneTest::cleanup() {
    scene_.reset();
    bench_.reset();
}

void SurfaceSceneTest::change(const std::function<void(StudioSettings&)>& edit) {
    bench_->document().change("Test", edit);
}

void SurfaceSceneTest::wait_for_surface() {
    QTRY_VERIFY_WITH_TIMEOUT(bench_->surface().surface() && !bench_->surface().busy(), 60000);
}

/// Until all that was wished for so far is shown in full.
void SurfaceSceneTest::wait_for_picture() {
    const quint64 wish = view().painter().paint(
        [](QSize) -> std::unique_ptr<Painting> { throw std::runtime_error("barrier"); }, {1, 1},
        false);
    QVERIFY(wish > 0);
    QSignalSpy failed(&view().painter(), &Painter::failed);
    QTRY_VERIFY_WITH_TIMEOUT(failed.count() > 0, 60000);
    view().refresh();
    QTRY_VERIFY_WITH_TIMEOUT(view().frame().wish > wish && view().frame().passes >= 1, 60000);
}

void SurfaceSceneTest::draw() {
    QSignalSpy completed(&bench_->drawing(), &Drawing::completed);
    bench_->draw_to_textures();
    QTRY_COMPARE_WITH_TIMEOUT(completed.count(), 1, 60000);
    QTest::qWait(150);  // the scene takes a grown layer ten times a second
    wait_for_picture();
}

int SurfaceSceneTest::count(const std::function<bool(QColor)>& wanted) {
    const QImage picture = view().grab_picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) count += wanted(picture.pixelColor(x, y));
    return count;
}

QPointF SurfaceSceneTest::place_of(double theta, double phi) {
    const Vec3 at = SurfaceFrame::direction_to_world(from_spherical(theta, phi));
    return view().project(kDomeRadius * at).value_or(QPointF(-1, -1));
}

void SurfaceSceneTest::roughness_zero_is_pure_green_in_red_lines() {
    const auto green = [](QColor c) { return c == QColor(0, 255, 0); };
    const auto red = [](QColor c) { return c.red() > 100 && c.green() < 80 && c.blue() < 80; };
    QVERIFY(count(green) > 2000);
    QVERIFY(count(red) > 200);
    const QPointF middle = *view().project({0, 0, 0});
    const QPointF corner = *view().project({-0.9, 0, -0.9});
    for (const QPointF place : {middle, corner})
        QVERIFY(view().frame().image.pixelColor(place.toPoint()) == QColor(0, 255, 0));
    change([](StudioSettings& s) { s.surface_view.beam = false; });
    QVERIFY(count(red) < 30);  // of the axis cross
}

void SurfaceSceneTest::mirror_direction_is_where_its_cell_is() {
    // Layer 1 of 3: 30 degrees up, so 60 from the normal, mirrored to phi = 180.
    const Detector detector(bench_->settings().experiment.detector);
    const double theta = radians(60.5), phi = radians(182);
    const QPointF place = place_of(theta, phi);
    QVERIFY(QRectF(view().rect()).contains(place));
    QCOMPARE(scene_->cell_at(place), std::optional(detector.cell_of(from_spherical(theta, phi))));
    // Every cell in sight lies where the dome has it.
    int seen = 0;
    for (int cell = 0; cell < detector.cells(); ++cell) {
        const Vec3 centre = detector.centre(cell);
        const QPointF at = place_of(polar_angle(centre), azimuth(centre));
        if (!QRectF(view().rect()).contains(at)) continue;
        const auto found = scene_->cell_at(at);
        if (!found) continue;  // behind the surface
        const WorldRay ray = view().ray_at(at);
        const Vec3 far = *dome_direction(ray);
        if (length(far - SurfaceFrame::direction_to_world(centre)) > 0.01) continue;  // near side
        QCOMPARE(*found, cell);
        ++seen;
    }
    QVERIFY(seen > 20);
}

void SurfaceSceneTest::surface_and_ground_are_no_cells() {
    QVERIFY(!scene_->cell_at(*view().project({0, 0, 0})));
    QVERIFY(!scene_->cell_at({240, 265}));
    const QPointF sky = place_of(radians(70), radians(190));
    QVERIFY(scene_->cell_at(sky));
    change([](StudioSettings& s) { s.surface_view.dome = false; });
    QVERIFY(!scene_->cell_at(sky));
}

void SurfaceSceneTest::click_selects_and_gives_up() {
    const QPoint sky = place_of(radians(70), radians(190)).toPoint();
    const auto outline = [](QColor c) {
        return c.red() > 240 && c.green() > 240 && c.blue() > 240;
    };
    const int before = count(outline);
    QTest::mouseClick(&view(), Qt::LeftButton, {}, sky);
    QCOMPARE(bench_->selected_cell(), scene_->cell_at(sky));
    QVERIFY(bench_->selected_cell());
    QVERIFY(count(outline) > before + 20);  // its edge is drawn
    QTest::mouseClick(&view(), Qt::LeftButton, {}, sky);
    QVERIFY(!bench_->selected_cell());
    QTest::mouseClick(&view(), Qt::LeftButton, {}, sky);
    QTest::keyClick(&view(), Qt::Key_Escape);
    QVERIFY(!bench_->selected_cell());
    QTest::mouseClick(&view(), Qt::LeftButton, {}, sky);
    QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(240, 265));  // off the dome
    QVERIFY(!bench_->selected_cell());
}

void SurfaceSceneTest::drawn_layer_lights_the_dome() {
    // A flat mirror: all light is in the cell of the mirror direction, phi = 180.
    change([](StudioSettings& s) { s.surface_view.beam = false; });
    const Detector detector(bench_->settings().experiment.detector);
    const int mirror = detector.cell_of(from_spherical(radians(60), kPi));
    const auto red = [](QColor c) { return c.red() > 90 && c.green() < 255; };
    const Vec3 centre = detector.centre(mirror);
    const QPoint place = place_of(polar_angle(centre), azimuth(centre)).toPoint();
    QCOMPARE(scene_->cell_at(place), std::optional(mirror));
    QCOMPARE(view().frame().image.pixelColor(place).red() > 90, false);
    draw();
    QVERIFY(red(view().frame().image.pixelColor(place)));
    const QPoint other = place_of(polar_angle(centre), azimuth(centre) + 0.3).toPoint();
    QCOMPARE(view().frame().image.pixelColor(other), QColor(Qt::black));
    // Another layer lights another cell; cleared, none.
    change([](StudioSettings& s) { s.surface_view.current_layer = 2; });
    wait_for_picture();
    QCOMPARE(view().frame().image.pixelColor(place), QColor(Qt::black));
    change([](StudioSettings& s) { s.surface_view.current_layer = 1; });
    wait_for_picture();
    QVERIFY(red(view().frame().image.pixelColor(place)));
    bench_->drawing().clear();
    QTest::qWait(150);
    wait_for_picture();
    QVERIFY(!red(view().frame().image.pixelColor(place)));
}

void SurfaceSceneTest::readings_tell_what_was_measured() {
    const Detector detector(bench_->settings().experiment.detector);
    const int mirror = detector.cell_of(from_spherical(radians(60), kPi));
    const Vec3 centre = detector.centre(mirror);
    const QPointF place = place_of(polar_angle(centre), azimuth(centre));
    QVERIFY(scene_->reading_at(place).contains("θ 59.1°  φ 185.6°"));
    QVERIFY(!scene_->reading_at(place).contains("f ="));
    draw();
    // All energy of one ray in this cell: f = 1 / projected solid angle.
    const double f = 1 / detector.projected_solid_angle(mirror / detector.columns());
    QVERIFY2(scene_->reading_at(place).contains(QString("f = %1 ± 0").arg(f, 0, 'g', 3)),
             qPrintable(scene_->reading_at(place)));
    const QString label =
        layer_text(bench_->settings().experiment.illumination, 1, bench_->drawing().layers(), -1);
    QVERIFY2(label.startsWith("Layer 1 of 3 · incident angle 60.0° · albedo 1.0000"),
             qPrintable(label));
    QVERIFY(layer_text(bench_->settings().experiment.illumination, 1, {}, -1)
                .contains("not drawn yet"));
}

void SurfaceSceneTest::layer_changes_the_beam() {
    const SurfaceBody body(*bench_->surface().surface());
    const Beam slanting(from_spherical(radians(60), 0), body);
    // From +x, 60 degrees from the normal, which is the world's y.
    QVERIFY(length(slanting.to_light - Vec3{std::sin(radians(60)), 0.5, 0}) < 1e-12);
    // The window keeps the size of the tile and stands across the light.
    QVERIFY(std::abs(length(slanting.right) - 1) < 1e-12);
    QVERIFY(std::abs(length(slanting.up) - 1) < 1e-12);
    for (const Vec3 corner : slanting.window())
        QVERIFY(std::abs(dot(corner, slanting.to_light) - Beam::kReach) < 1e-12);
    const QImage before = view().grab_picture();
    change([](StudioSettings& s) { s.surface_view.current_layer = 3; });
    wait_for_picture();
    const Beam above({0, 0, 1}, body);
    const QPoint corner = view().project(above.window()[2])->toPoint();
    if (view().rect().adjusted(2, 2, -2, -2).contains(corner)) {
        bool red = false;
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
                red = red || view().grab_picture().pixelColor(corner + QPoint(dx, dy)).red() > 100;
        QVERIFY(red);
    }
    QVERIFY(before != view().grab_picture());
}

void SurfaceSceneTest::jitter_shows_copies_of_the_beam() {
    const auto reddish = [](QColor c) { return c.red() > 30 && c.red() > 2 * c.green() + 10; };
    change([](StudioSettings& s) { s.experiment.run.jitter = 1; });
    wait_for_picture();
    const int one = count(reddish);
    change([](StudioSettings& s) { s.experiment.run.jitter = 3; });
    wait_for_picture();
    QVERIFY(count(reddish) > one + one / 4);
}

void SurfaceSceneTest::paths_lead_from_the_light_to_their_cell() {
    change([](StudioSettings& s) {
        s.experiment.surface.roughness = 0.2;
        s.surface_view.paths = true;
        s.surface_view.path_count = 50;
    });
    wait_for_surface();
    QTRY_VERIFY_WITH_TIMEOUT(!bench_->light().busy() && bench_->light().paths().size() == 50,
                             60000);
    const SurfaceBody body(*bench_->surface().surface());
    const Detector detector(bench_->settings().experiment.detector);
    for (const LightPath& path : bench_->light().paths()) {
        const std::vector<Vec3> corners = corners_in_world(path, body);
        if (path.end != PathEnd::Escaped) continue;
        QCOMPARE(corners.size(), path.points.size() + 2);
        QVERIFY(std::abs(length(corners.back()) - kDomeRadius) < 1e-9);
        QVERIFY(std::abs(corners[1].x) <= 1 && std::abs(corners[1].z) <= 1);  // on the tile
        const Vec3 way = normalize(corners[1] - corners[0]);
        QVERIFY(length(way + SurfaceFrame::direction_to_world(path.wi)) < 1e-9);
        // The dome lies far away, so the cell is nearly the one the line ends in.
        const Vec3 end = SurfaceFrame::direction_to_surface(normalize(corners.back()));
        QVERIFY(dot(end, detector.centre(path.cell)) > std::cos(radians(25)));
    }
    wait_for_picture();
    const QColor ink = colour_of_bounce(1);
    const auto amber = [ink](QColor c) {
        return c.red() > 120 && c.green() > 0.6 * c.red() && c.green() < 0.95 * c.red() &&
               c.blue() < 0.5 * c.red() && ink.isValid();
    };
    const int with = count(amber);
    change([](StudioSettings& s) { s.surface_view.paths = false; });
    QTRY_VERIFY_WITH_TIMEOUT(bench_->light().paths().empty(), 60000);
    wait_for_picture();
    QVERIFY(with > count(amber) + 100);
}

void SurfaceSceneTest::paths_of_a_cell_light_their_facets() {
    change([](StudioSettings& s) { s.surface_view.paths = true; });
    const Detector detector(bench_->settings().experiment.detector);
    const auto pale = [this] {
        const QImage& image = view().frame().image;
        int count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const QColor c = image.pixelColor(x, y);
                count += c.red() > 180 && c.green() > 200 && c.blue() > 120;
            }
        return count;
    };
    QTRY_VERIFY_WITH_TIMEOUT(!bench_->light().busy(), 60000);
    wait_for_picture();
    QCOMPARE(pale(), 0);
    bench_->select_cell(detector.cell_of(from_spherical(radians(60), kPi)));
    QTRY_VERIFY_WITH_TIMEOUT(!bench_->light().busy() && !bench_->light().paths().empty(), 60000);
    wait_for_picture();
    QVERIFY(pale() > 100);
    bench_->select_cell(std::nullopt);
    QTRY_VERIFY_WITH_TIMEOUT(!bench_->light().busy(), 60000);
    wait_for_picture();
    QCOMPARE(pale(), 0);
}

void SurfaceSceneTest::camera_type_follows_the_settings() {
    const Vec3 before = view().camera().position;
    change([](StudioSettings& s) { s.surface_view.camera_type = CameraType::FirstPerson; });
    QTest::keyPress(&view(), Qt::Key_W);
    QTest::qWait(100);
    QTest::keyRelease(&view(), Qt::Key_W);
    QVERIFY(length(view().camera().position - before) > 0.01);
    QTest::keyClick(&view(), Qt::Key_R);
    QVERIFY(length(view().camera().position - before) < 1e-6);
}

void SurfaceSceneTest::empty_scene_without_extras() {
    change([](StudioSettings& s) {
        s.surface_view.beam = s.surface_view.dome = false;
        s.surface_view.shading = SurfaceShading::Lit;
    });
    wait_for_picture();
    QCOMPARE(count([](QColor c) { return c == QColor(0, 255, 0); }), 0);
    QVERIFY(count([](QColor c) { return c.lightness() > 60; }) > 2000);  // the tile in its light
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::SurfaceSceneTest)
#include "surface_scene_test.moc"
