// SPDX-License-Identifier: Apache-2.0
// The lobe over the surface reaches as far as f is large, and rays meet it there.
#include "model/lobe.h"

#include "model/dome.h"
#include "model/surface_frame.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>

#include <QTest>

#include <cmath>

namespace asperity::studio {
namespace {

/// One layer with f as a function of the direction, of 2^20 rays without error bars.
struct OneLayer {
    Measurement head;
    Layer layer;

    template <class OfDirection>
    explicit OneLayer(const OfDirection& f, int resolution = 64) {
        head.experiment.detector = {DetectorKind::LatLong, resolution, 1};
        head.detector = Detector(head.experiment.detector);
        head.channel_names = {"f"};
        layer.number = 15;
        layer.rays = 1U << 20;
        for (int cell = 0; cell < head.detector.cells(); ++cell) {
            const double share =
                head.detector.projected_solid_angle(cell / head.detector.columns());
            layer.energy.push_back(
                static_cast<std::uint64_t>(std::ldexp(share * f(head.detector.centre(cell)), 50)));
        }
    }
};

const io::SkyMapSettings kLinear{io::ColourMap::Viridis, io::Scale::Linear};

Hit look(const Lobe& lobe, Vec3 from, Vec3 direction) {
    const WorldRay ray{from, normalize(direction)};
    Hit hit;
    lobe.look({&ray, 1}, {&hit, 1});
    return hit;
}

}  // namespace

class LobeTest : public QObject {
    Q_OBJECT

  private slots:
    void even_light_makes_a_hemisphere();
    void reaches_as_far_as_f_is_large();
    void nothing_has_no_lobe();
    void unsure_is_grey();
    void models_are_shells_on_the_same_scale();
};

void LobeTest::even_light_makes_a_hemisphere() {
    const OneLayer even([](Vec3) { return 1; });
    const Lobe lobe(even.head, even.layer, kLinear);
    for (const double theta : {0.1, 0.7, 1.4})
        for (const double phi : {0.3, 2.0, 5.0}) {
            const Vec3 d = SurfaceFrame::direction_to_world(from_spherical(theta, phi));
            const Hit hit = look(lobe, 10 * d, -1.0 * d);
            QVERIFY(hit.found());
            // Between its corners the net lies a little inside the sphere
            const double radius = 10 - static_cast<double>(hit.distance);
            QVERIFY(radius <= Lobe::kLobeRadius + 1e-4 && radius > 0.99 * Lobe::kLobeRadius);
            QVERIFY(dot(Lobe::direction({10 * d, -1.0 * d}, hit), from_spherical(theta, phi)) >
                    0.9999);
        }
    QVERIFY(!look(lobe, {10, -1, 0}, {-1, 0, 0}).found());  // below the horizon there is none
}

void LobeTest::reaches_as_far_as_f_is_large() {
    // f = cos^2: a quarter as far at 60 degrees; a detector finer than the net is averaged
    for (const int resolution : {64, 256}) {
        const OneLayer squared([](Vec3 d) { return d.z * d.z; }, resolution);
        const Lobe lobe(squared.head, squared.layer, kLinear);
        const auto radius = [&](double theta) {
            const Vec3 d = SurfaceFrame::direction_to_world(from_spherical(theta, 1.1));
            return 10 - static_cast<double>(look(lobe, 10 * d, -1.0 * d).distance);
        };
        QVERIFY(std::abs(radius(radians(2)) / Lobe::kLobeRadius - 1) < 0.02);
        QVERIFY(std::abs(radius(radians(45)) / Lobe::kLobeRadius - 0.5) < 0.02);
        QVERIFY(std::abs(radius(radians(60)) / Lobe::kLobeRadius - 0.25) < 0.02);
        QVERIFY(std::abs(lobe.reach(from_spherical(radians(45), 1)) / Lobe::kLobeRadius - 0.5) <
                0.03);
    }
}

void LobeTest::nothing_has_no_lobe() {
    const OneLayer nothing([](Vec3) { return 0; });
    const Lobe lobe(nothing.head, nothing.layer, kLinear);
    QVERIFY(!look(lobe, {0, 10, 0}, {0, -1, 0}).found());
}

void LobeTest::unsure_is_grey() {
    OneLayer even([](Vec3) { return 1; });
    const auto chroma = [&] {
        const Lobe lobe(even.head, even.layer, kLinear);
        const WorldRay ray{{0, 8, 6}, normalize({0, -8, -6})};
        const Hit hit = look(lobe, ray.origin, ray.direction);
        const Lobe::Pixel c = lobe.colour(ray, hit);
        return *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end());
    };
    const float sure = chroma();
    const auto cells = static_cast<std::size_t>(even.head.detector.cells());
    even.layer.stderr_energy.assign(cells, 0);
    for (std::size_t cell = 0; cell < cells; ++cell)  // the error is as large as the value
        even.layer.stderr_energy[cell] =
            static_cast<float>(std::ldexp(static_cast<double>(even.layer.energy[cell]), -32) /
                               static_cast<double>(even.layer.rays));
    QVERIFY(sure > 100);
    QVERIFY(chroma() < 10);
}

void LobeTest::models_are_shells_on_the_same_scale() {
    // f of the layer is the same all over, and so is that of a Lambertian surface: albedo / pi
    const OneLayer even([](Vec3) { return 1; });
    const double expected = 0.5 / kPi / even.head.brdf(even.layer, 0, 40);
    QVERIFY(expected > 0.2 && expected < 0.9);
    const Lobe::Pixel tint = {250, 120, 20};
    const Lobe own(even.head, even.layer, kLinear);
    const Lobe shell(*parse_brdf_spec("lambert:albedo=0.5"), even.head, even.layer, kLinear, tint);
    for (const double theta : {0.2, 0.8, 1.3}) {
        const Vec3 d = from_spherical(theta, 2.5);
        QVERIFY(std::abs(own.reach(d) - Lobe::kLobeRadius) < 1e-3);
        const double share = shell.reach(d) / Lobe::kLobeRadius;
        QVERIFY2(std::abs(share - expected) < 1e-3, qPrintable(QString::number(share)));
    }
    QVERIFY(std::abs(shell.radius() - expected * Lobe::kLobeRadius) < 1e-2);
    // Brighter than all there is: cut off within the dome
    const Lobe mirror(*parse_brdf_spec("beckmann:alpha=0.02,f0=1"), even.head, even.layer, kLinear,
                      tint);
    QVERIFY(mirror.radius() < kDomeRadius && mirror.radius() >= Lobe::kLobeRadius);
    // Clear in the middle, less at the rim; the layer's own lobe hides what lies behind
    const auto opacity = [](const Lobe& lobe, double aside) {
        const WorldRay ray{{aside, 10, 0}, {0, -1, 0}};
        Hit hit;
        lobe.look({&ray, 1}, {&hit, 1});
        return hit.found() ? lobe.opacity(ray, hit) : -1;
    };
    const double middle = opacity(shell, 0.02), rim = opacity(shell, 0.97 * shell.radius());
    QVERIFY2(middle > 0 && middle < 0.2, qPrintable(QString::number(middle)));
    QVERIFY2(rim > 2 * middle && rim < 1, qPrintable(QString::number(rim)));
    QVERIFY(opacity(own, 0.02) > 0.85);
    const WorldRay ray{{0.02, 10, 0}, {0, -1, 0}};
    Hit hit;
    shell.look({&ray, 1}, {&hit, 1});
    const Lobe::Pixel colour = shell.colour(ray, hit);
    QVERIFY(colour[0] > colour[1] && colour[1] > colour[2]);  // its tint
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::LobeTest)
#include "lobe_test.moc"
