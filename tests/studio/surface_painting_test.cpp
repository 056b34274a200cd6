// SPDX-License-Identifier: Apache-2.0
// Pictures of the surface scene, pixel by pixel: where the surface lies, what colour it has, what
// the dome shows.
#include "model/surface_painting.h"

#include <asperity/core/directions.h>
#include <asperity/render/camera.h>
#include <asperity/surface/make_surface.h>

#include <QTest>

#include <cmath>

namespace asperity::studio {
namespace {

constexpr QSize kSize(160, 90);

Heightfield thesis_surface(double roughness, int size = 64) {
    SurfaceSettings settings;
    settings.size = size;
    settings.roughness = roughness;
    asperity::Run run(1);
    return make_surface(settings, run);
}

std::shared_ptr<const Lazy<SurfaceBody>> body_of(const Heightfield& surface) {
    return std::make_shared<const Lazy<SurfaceBody>>([surface] { return SurfaceBody(surface); });
}

/// From outside, obliquely from above: tile and background are both seen.
Camera from_above() {
    return look_at({1.5, 2.5, 3}, {0, 0, 0}, 50);
}

QImage painted(const SurfacePicture& picture, const Camera& camera, int passes = 1) {
    asperity::Run run(2);
    const std::unique_ptr<Painting> painting = paint_surface(picture, camera)(kSize);
    for (int k = 0; k < passes; ++k) painting->pass(run);
    return painting->image();
}

/// A measurement of one layer, all of whose cells have f = 1 but one, which has none.
struct OneLayer {
    std::shared_ptr<Measurement> head = std::make_shared<Measurement>();
    Layer layer;

    explicit OneLayer(int dark_cell) {
        head->experiment.detector = {DetectorKind::LatLong, 32, 1};
        head->detector = Detector(head->experiment.detector);
        head->channel_names = {"f"};
        layer.number = 15;
        layer.rays = 1U << 20;
        for (int cell = 0; cell < head->detector.cells(); ++cell) {
            const double share =
                head->detector.projected_solid_angle(cell / head->detector.columns());
            layer.energy.push_back(
                cell == dark_cell ? 0 : static_cast<std::uint64_t>(std::ldexp(share, 52)));
        }
    }

    std::shared_ptr<const Lazy<DomePicture>> dome() const {
        return std::make_shared<const Lazy<DomePicture>>([measurement = head, shown = layer] {
            return DomePicture(*measurement, shown, {io::ColourMap::ThesisRed});
        });
    }
};

}  // namespace

class SurfacePaintingTest : public QObject {
    Q_OBJECT

  private slots:
    void frame_puts_the_tile_into_the_middle();
    void smooth_surface_is_pure_green();
    void rough_surface_has_the_colours_of_its_normals();
    void lit_relief_is_neither_flat_nor_green();
    void passes_refine_edges_and_end();
    void dome_shows_its_cells();
    void unlit_cells_are_black();
    void without_a_layer_all_is_dark();
    void selected_facets_stand_out();
    void matter_hides_what_is_below_it();
    void stop_is_heard();
    void lazy_is_made_once();
};

void SurfacePaintingTest::frame_puts_the_tile_into_the_middle() {
    Heightfield surface = thesis_surface(0);
    surface.dx = 0.5;  // 32 x 64 long
    const SurfaceFrame frame = SurfaceFrame::of(surface, -1, 3);
    QCOMPARE(frame.to_world({16, 32, 1}), (Vec3{0, 0, 0}));
    QCOMPARE(frame.to_world({16, 64, 1}), (Vec3{0, 0, -1}));  // the longer side is 2 long
    QCOMPARE(frame.to_world({32, 32, 1}), (Vec3{0.5, 0, 0}));
    QCOMPARE(frame.to_world({16, 32, 33}), (Vec3{0, 1, 0}));  // heights in true proportion
    const Vec3 p{3, -2, 7};
    QVERIFY(length(frame.to_surface(frame.to_world(p)) - p) < 1e-12);
    const Camera camera = from_above();
    const Camera there = frame.to_surface(camera);
    // The same rays, whichever frame they are made in.
    const WorldRay here = frame.to_surface(PixelRays(camera, 160, 90).at(31, 17));
    const WorldRay same = PixelRays(there, 160, 90).at(31, 17);
    QVERIFY(length(here.origin - same.origin) < 1e-12);
    QVERIFY(length(here.direction - same.direction) < 1e-12);
}

void SurfacePaintingTest::smooth_surface_is_pure_green() {
    const Camera camera = from_above();
    const QImage image =
        painted({body_of(thesis_surface(0)), {}, SurfaceShading::Normals, {}}, camera);
    const PixelRays rays(camera, kSize.width(), kSize.height());
    int green = 0;
    for (int y = 0; y < kSize.height(); ++y) {
        for (int x = 0; x < kSize.width(); ++x) {
            // By hand: the plane y = 0, the square of side 2 about the origin.
            const WorldRay ray = rays.at(x + 0.5, y + 0.5);
            const Vec3 at = ray.origin - (ray.origin.y / ray.direction.y) * ray.direction;
            const bool inside = ray.direction.y < 0 && std::abs(at.x) < 1 && std::abs(at.z) < 1;
            const QColor colour = image.pixelColor(x, y);
            if (inside) QCOMPARE(colour, QColor(0, 255, 0));
            if (!inside) QVERIFY(colour.green() < 20);
            green += inside;
        }
    }
    QVERIFY(green > 1000);
}

void SurfacePaintingTest::rough_surface_has_the_colours_of_its_normals() {
    const Heightfield surface = thesis_surface(1);
    const Camera above = look_at({0, 4, 0}, {0, 0, 0}, 30);
    const QImage image = painted({body_of(surface), {}, SurfaceShading::Normals, {}}, above);
    const SurfaceBody body(surface);
    const PixelRays rays(above, kSize.width(), kSize.height());
    double red = 0, green = 0, blue = 0;
    for (int y = 10; y < 80; ++y) {
        for (int x = 45; x < 115; ++x) {
            const PatchHit hit =
                body.view().look(body.frame().to_surface(rays.at(x + 0.5, y + 0.5)));
            QVERIFY(hit.part == PatchPart::Facet);
            const QColor c = image.pixelColor(x, y);
            QVERIFY(std::abs(c.red() - 255 * std::abs(hit.normal.x)) <= 1);
            QVERIFY(std::abs(c.green() - 255 * std::abs(hit.normal.z)) <= 1);
            QVERIFY(std::abs(c.blue() - 255 * std::abs(hit.normal.y)) <= 1);
            red += c.red(), green += c.green(), blue += c.blue();
        }
    }
    // Roughness 1: heights up to ten cells, facets steep; purple, not green.
    QVERIFY(red > 2 * green && blue > 2 * green);
}

void SurfacePaintingTest::lit_relief_is_neither_flat_nor_green() {
    const QImage image =
        painted({body_of(thesis_surface(0.3)), {}, SurfaceShading::Lit, {}}, from_above());
    int darkest = 255, brightest = 0;
    for (int x = 60; x < 100; ++x) {
        const QColor c = image.pixelColor(x, 45);
        darkest = std::min(darkest, c.lightness());
        brightest = std::max(brightest, c.lightness());
        QVERIFY(c.hslSaturation() < 230);
    }
    QVERIFY(brightest > darkest + 60);
}

void SurfacePaintingTest::passes_refine_edges_and_end() {
    asperity::Run run(2);
    const SurfacePicture picture{body_of(thesis_surface(0)), {}, SurfaceShading::Normals, {}};
    const auto painting = paint_surface(picture, from_above())(kSize);
    const auto between = [&] {
        int count = 0;
        for (int y = 0; y < kSize.height(); ++y)
            for (int x = 0; x < kSize.width(); ++x) {
                const int green = painting->image().pixelColor(x, y).green();
                count += green > 40 && green < 215;
            }
        return count;
    };
    QVERIFY(painting->pass(run));
    QCOMPARE(between(), 0);
    int passes = 1;
    while (painting->pass(run)) ++passes;
    QCOMPARE(passes + 1, kSurfaceSamples);
    QVERIFY(between() > 50);
}

void SurfacePaintingTest::dome_shows_its_cells() {
    // One dark cell 45 degrees up, straight ahead of a camera that looks along world -z: phi = 90.
    const Detector detector({DetectorKind::LatLong, 32, 1});
    const int dark = detector.cell_of(from_spherical(radians(42), radians(95)));
    const OneLayer layer(dark);
    const Camera camera = look_at({0, 0, 0.001}, kDomeRadius * Vec3{0, 1, -1}, 90);
    const QImage image = painted({{}, layer.dome(), SurfaceShading::Normals, {}}, camera);
    const PixelRays rays(camera, kSize.width(), kSize.height());
    int dark_pixels = 0;
    for (int y = 0; y < kSize.height(); ++y) {
        for (int x = 0; x < kSize.width(); ++x) {
            const std::optional<Vec3> seen = dome_direction(rays.at(x + 0.5, y + 0.5));
            QVERIFY(seen);
            if (seen->y < 0) continue;
            const bool black = image.pixelColor(x, y) == QColor(Qt::black);
            QCOMPARE(black, detector.cell_of(SurfaceFrame::direction_to_surface(*seen)) == dark);
            dark_pixels += black;
        }
    }
    QVERIFY(dark_pixels > 10);
}

void SurfacePaintingTest::unlit_cells_are_black() {
    OneLayer layer(-1);
    const DomePicture full(*layer.head, layer.layer, {io::ColourMap::ThesisRed});
    const io::Colour wanted = io::colour_of_value(1, full.scale(), io::ColourMap::ThesisRed);
    const auto lit = full.colour({0, 0, 1});
    QVERIFY(std::abs(double{lit[0]} - 255 * wanted.r) < 1 && lit[0] > 200);
    QVERIFY(std::abs(double{lit[2]} - 255 * wanted.b) < 1);
    std::fill(layer.layer.energy.begin() + 1, layer.layer.energy.end(), 0);
    const DomePicture empty(*layer.head, layer.layer, {io::ColourMap::ThesisRed});
    QCOMPARE(empty.colour(from_spherical(1, 2)), (DomePicture::Pixel{0, 0, 0}));
}

void SurfacePaintingTest::without_a_layer_all_is_dark() {
    const QImage image = painted({}, look_at({0, 1, 4}, {0, 0, 0}, 60));
    for (int y = 0; y < kSize.height(); ++y)
        for (int x = 0; x < kSize.width(); ++x) QVERIFY(image.pixelColor(x, y).lightness() < 20);
}

void SurfacePaintingTest::selected_facets_stand_out() {
    const Heightfield surface = thesis_surface(0, 4);
    LightPath path;
    path.facets = {{1, 2, Triangle::Lower}};
    const auto selected = std::make_shared<const FacetSet>(std::vector<LightPath>{path});
    const Camera above = look_at({0, 3, 0}, {0, 0, 0}, 40);
    const QImage image = painted({body_of(surface), {}, SurfaceShading::Normals, selected}, above);
    // The middle of the lower triangle of cell (1, 2), x = 1 1/3, y = 2 1/3 of 4.
    const auto pixel = [&](double x, double y) {
        const Vec3 at{x / 2 - 1, 0, 1 - y / 2};  // looked at from above, -z is up in the picture
        const double side = 2 * 3 * std::tan(radians(20)) / kSize.height();
        return image.pixelColor(static_cast<int>(80 + at.x / side),
                                static_cast<int>(45 + at.z / side));
    };
    QVERIFY(pixel(1.33, 2.33).red() > 200);
    QCOMPARE(pixel(1.75, 2.75), QColor(0, 255, 0));  // its upper neighbour
    QCOMPARE(pixel(2.33, 2.33), QColor(0, 255, 0));
    QCOMPARE(pixel(1.33, 1.33), QColor(0, 255, 0));
}

void SurfacePaintingTest::matter_hides_what_is_below_it() {
    const SurfaceBody body(thesis_surface(0));
    const Vec3 eye{0, 3, 2};
    QVERIFY(body.hides(eye, {0, -1, 0}));
    QVERIFY(!body.hides(eye, {0, 0, 0}));        // on the surface
    QVERIFY(!body.hides(eye, {0, 0.5, 0}));      // above it
    QVERIFY(!body.hides(eye, {0, -1, -5}));      // seen past its edge
    QVERIFY(body.hides({0, -3, 0}, {0, 1, 0}));  // from below
}

void SurfacePaintingTest::stop_is_heard() {
    asperity::Run run(1);
    run.request_stop();
    const auto painting = paint_surface(
        {body_of(thesis_surface(1)), {}, SurfaceShading::Normals, {}}, from_above())({4000, 4000});
    QElapsedTimer clock;
    clock.start();
    QVERIFY(!painting->pass(run));
    QVERIFY(clock.elapsed() < 200);
}

void SurfacePaintingTest::lazy_is_made_once() {
    int made = 0;
    const Lazy<int> number([&made] { return ++made; });
    QVERIFY(!number.if_made());
    QCOMPARE(number.get(), 1);
    QCOMPARE(number.get(), 1);
    QVERIFY(number.if_made());
    QCOMPARE(*number.if_made(), 1);
    int tries = 0;
    const Lazy<int> second([&tries]() -> int {
        if (++tries == 1) throw std::runtime_error("no");
        return 7;
    });
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, second.get());
    QVERIFY(!second.if_made());
    QCOMPARE(second.get(), 7);
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::SurfacePaintingTest)
#include "surface_painting_test.moc"
