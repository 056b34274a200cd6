// SPDX-License-Identifier: Apache-2.0
// Noise is taken out of what is shown, edges are not; sketches have them from the first; and the
// studio's soft sky is as bright as it says.
#include "model/denoise.h"
#include "model/sketch.h"
#include "model/soft_sky.h"

#include <asperity/core/directions.h>
#include <asperity/render/builtin_models.h>

#include <QTest>

#include <algorithm>
#include <cmath>
#include <random>

namespace asperity::studio {
namespace {

constexpr int kWidth = 96, kHeight = 64;

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
}

/// A wall across the view whose right half is turned away: one edge of the normals, none of places.
PixelGuides folded_wall() {
    PixelGuides guides{kWidth, kHeight, {}, {}, {}, {}, {}, {}, {}};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool left = x < kWidth / 2;
            guides.nx.push_back(left ? 0.0F : 1.0F);
            guides.ny.push_back(0);
            guides.nz.push_back(left ? 1.0F : 0.0F);
            guides.px.push_back(0.01F * static_cast<float>(left ? x : kWidth / 2));
            guides.py.push_back(0.01F * static_cast<float>(y));
            guides.pz.push_back(0.01F * static_cast<float>(left ? 0 : kWidth / 2 - x));
            guides.reach.push_back(0.02F);
        }
    return guides;
}

/// Grey 1 on the left, 3 on the right, each sample off by up to `noise` of it.
Film noisy_film(int samples, double noise) {
    Film film(kWidth, kHeight);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> off(-noise, noise);
    for (int k = 0; k < samples; ++k)
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double grey = (x < kWidth / 2 ? 1 : 3) * (1 + off(random));
                film.at(x, y).add({grey, grey, grey});
            }
    return film;
}

/// Root mean square of the difference from 1 and 3, relative.
template <class GreyAt>
double error_of(const GreyAt& grey_at) {
    double squares = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double wanted = x < kWidth / 2 ? 1 : 3;
            const double off = grey_at(x, y) / wanted - 1;
            squares += off * off;
        }
    return std::sqrt(squares / (kWidth * kHeight));
}

double error_of(const std::vector<float>& rgb) {
    return error_of([&](int x, int y) { return double{rgb[3 * at(x, y)]}; });
}

}  // namespace

class DenoiseTest : public QObject {
    Q_OBJECT

  private slots:
    void noise_falls_and_the_edge_stays_data();
    void noise_falls_and_the_edge_stays();
    void what_is_sure_is_not_touched();
    void threads_do_not_matter();
    void guides_are_what_rays_meet();
    void guessed_guides_have_the_same_outlines();
    void a_sketch_knows_the_light_of_all_pixels_data();
    void a_sketch_knows_the_light_of_all_pixels();
    void a_sketch_samples_what_is_like_nothing_else();
    void a_sketch_forgets_a_single_bright_sample();
    void soft_sky_has_the_luminance_of_one();
};

void DenoiseTest::noise_falls_and_the_edge_stays_data() {
    QTest::addColumn<int>("samples");
    QTest::newRow("1 sample") << 1;
    QTest::newRow("4 samples") << 4;
    QTest::newRow("16 samples") << 16;
}

void DenoiseTest::noise_falls_and_the_edge_stays() {
    QFETCH(int, samples);
    const Film film = noisy_film(samples, 0.9);
    const double before = error_of([&](int x, int y) { return film.at(x, y).mean.g; });
    asperity::Run run(2);
    const std::vector<float> clean = denoised(film, folded_wall(), run);
    QVERIFY2(error_of(clean) < 0.35 * before,
             qPrintable(QString("%1 of %2").arg(error_of(clean)).arg(before)));
    // Beside the fold nothing of the other side has come over: 3 would lift the mean of 1
    double left = 0, right = 0;
    for (int y = 0; y < kHeight; ++y) {
        left += double{clean[3 * at(kWidth / 2 - 1, y)]} / kHeight;
        right += double{clean[3 * at(kWidth / 2, y)]} / kHeight;
    }
    QVERIFY(std::abs(left - 1) < 0.12 && std::abs(right / 3 - 1) < 0.12);
}

void DenoiseTest::what_is_sure_is_not_touched() {
    // Stripes of one pixel, every sample the same: no error, though normals see no edge
    Film film(kWidth, kHeight);
    for (int k = 0; k < 8; ++k)
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double grey = x % 2 == 0 ? 0.25 : 0.5;
                film.at(x, y).add({grey, grey, grey});
            }
    asperity::Run run(2);
    const std::vector<float> clean = denoised(film, folded_wall(), run);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            QVERIFY(std::abs(double{clean[3 * at(x, y)]} - film.at(x, y).mean.r) < 1e-3);
}

void DenoiseTest::threads_do_not_matter() {
    const Film film = noisy_film(2, 0.5);
    asperity::Run one(1), three(3);
    QVERIFY(denoised(film, folded_wall(), one) == denoised(film, folded_wall(), three));
}

void DenoiseTest::guides_are_what_rays_meet() {
    asperity::Run run(2);
    const TracedModel sphere(make_builtin_model("sphere"), run);
    const Camera camera = look_at({0, 0, 3}, {0, 0, 0}, 50);
    const PixelGuides guides = look_for_guides(sphere, camera, 65, 65, 0.75, run);
    const std::size_t middle = 32 * 65 + 32;
    QVERIFY(std::abs(guides.nz[middle] - 1) < 1e-3F && std::abs(guides.pz[middle] - 1) < 1e-3F);
    QVERIFY(guides.reach[middle] > 0);
    QCOMPARE(guides.reach[0], 0.0F);  // a corner: past the sphere
    const std::size_t other_side = 32 * 65 + 50;
    QVERIFY(guides.nz[other_side] > 0 && guides.pz[other_side] > 10);  // far from its neighbours
}

void DenoiseTest::guessed_guides_have_the_same_outlines() {
    asperity::Run run(2);
    const TracedModel knot(make_builtin_model("knot"), run);
    const Camera camera = look_at({0.5, 0.8, 3}, {0, 0, 0}, 45);
    const PixelGuides exact = look_for_guides(knot, camera, 301, 200, 0.5, run);
    const PixelGuides guessed = guess_guides(knot, camera, 301, 200, 0.5, run);
    std::size_t off = 0;
    for (std::size_t k = 0; k < exact.reach.size(); ++k) {
        QCOMPARE(guessed.reach[k] > 0, exact.reach[k] > 0);
        const Vec3 n{double{exact.nx[k]}, double{exact.ny[k]}, double{exact.nz[k]}};
        const Vec3 m{double{guessed.nx[k]}, double{guessed.ny[k]}, double{guessed.nz[k]}};
        constexpr double kFiveDegrees = 0.0872;
        off += length(cross(n, m)) > kFiveDegrees * length(m);
    }
    QVERIFY2(off < exact.reach.size() / 2000, qPrintable(QString::number(off)));
}

void DenoiseTest::a_sketch_knows_the_light_of_all_pixels_data() {
    QTest::addColumn<int>("stride");
    QTest::newRow("a fourth") << 2;
    QTest::newRow("a sixteenth") << 4;
}

void DenoiseTest::a_sketch_knows_the_light_of_all_pixels() {
    QFETCH(int, stride);
    const PixelGuides guides = folded_wall();
    asperity::Run one(1), three(3);
    const Sketch sketch(guides, stride, one);
    const auto count = std::count(sketch.chosen().begin(), sketch.chosen().end(), 1);
    // Those of one half that lie beyond the last of its nodes find others farther away
    QCOMPARE(count, kWidth * kHeight / (stride * stride));
    Film film(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (sketch.chosen()[at(x, y)] != 0) {
                const double grey = x < kWidth / 2 ? 1 : 3;
                film.at(x, y).add({grey, grey, grey});
            }
    const std::vector<float> rgb = sketch.filled(film, one);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            QVERIFY2(std::abs(double{rgb[3 * at(x, y)]} - (x < kWidth / 2 ? 1 : 3)) < 1e-3,
                     qPrintable(QString("%1, %2").arg(x).arg(y)));
    QVERIFY(rgb == sketch.filled(film, three));
}

void DenoiseTest::a_sketch_samples_what_is_like_nothing_else() {
    // One pixel between the nodes that faces elsewhere, and lies elsewhere
    PixelGuides guides = folded_wall();
    const std::size_t lone = at(13, 22);
    guides.nx[lone] = 0, guides.ny[lone] = 1, guides.nz[lone] = 0;
    guides.py[lone] += 5;
    asperity::Run run(2);
    const Sketch sketch(guides, 4, run);
    QVERIFY(sketch.chosen()[lone] == 1);
    Film film(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) film.at(x, y).add({1, 1, 1});
    film.at(13, 22) = {};
    film.at(13, 22).add({7, 7, 7});
    const std::vector<float> rgb = sketch.filled(film, run);
    QVERIFY(std::abs(double{rgb[3 * lone]} - 7) < 1e-6);
    QVERIFY(std::abs(double{rgb[3 * (lone + 1)]} - 1) < 1e-3);
}

void DenoiseTest::a_sketch_forgets_a_single_bright_sample() {
    const PixelGuides guides = folded_wall();
    asperity::Run run(2);
    const Sketch sketch(guides, 4, run);
    Film film = noisy_film(1, 0);
    film.at(20, 32) = {};
    film.at(20, 32).add({1000, 1000, 1000});
    const std::vector<float> rgb = sketch.filled(film, run);
    QVERIFY(std::abs(double{rgb[3 * at(20, 32)]} - 1) < 1e-3);
}

void DenoiseTest::soft_sky_has_the_luminance_of_one() {
    const std::shared_ptr<const Light> sky = make_soft_sky();
    double irradiance = 0;
    constexpr int kRows = 200, kColumns = 400;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            // Equal projected solid angles, y up
            const double s = std::sqrt((row + 0.5) / kRows), phi = 2 * kPi * column / kColumns;
            const Vec3 d{s * std::cos(phi), std::sqrt(1 - s * s), s * std::sin(phi)};
            irradiance += luminance(sky->radiance(d)) * kPi / (kRows * kColumns);
        }
    QVERIFY(std::abs(irradiance / kPi - 1) < 0.01);
    QVERIFY(std::abs(luminance(sky->radiance({0, -1, 0})) - 0.5) < 1e-6);
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::DenoiseTest)
#include "denoise_test.moc"
