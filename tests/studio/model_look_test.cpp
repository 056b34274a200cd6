// SPDX-License-Identifier: Apache-2.0
// The fields of the scene "Model" change its picture as physics says (thesis figures 2.13c,
// 2.17-2.21).
#include "model_testing.h"

#include <algorithm>

namespace asperity::studio {

namespace {

const Pixel& brightest(const Film& film) {
    return *std::max_element(
        film.pixels().begin(), film.pixels().end(),
        [](const Pixel& a, const Pixel& b) { return luminance(a.mean) < luminance(b.mean); });
}

/// Pixels at least half as bright as the brightest.
auto highlight_size(const Film& film) {
    const double half = 0.5 * luminance(brightest(film).mean);
    return std::count_if(film.pixels().begin(), film.pixels().end(),
                         [&](const Pixel& pixel) { return luminance(pixel.mean) >= half; });
}

/// The middle of the sphere, far from its rim.
Rgb middle(const Film& film) {
    return film.at(film.width() / 2, film.height() / 2).mean;
}

}  // namespace

class ModelLookTest : public QObject {
    Q_OBJECT

  private slots:
    void a_stopped_brdf_is_a_black_shape_on_grey();
    void metal_tints_its_highlight();
    void roughness_spreads_the_highlight();
    void albedo_colours_each_channel_apart();
    void normalize_factor_doubles_the_picture_exactly();
    void diffuse_albedo_adds_its_colour();
    void both_sides_of_the_split_are_the_whole_pictures();
    void light_moves_and_fades();
    void the_sky_is_seen_and_its_sun_moves();
    void reflections_light_a_bowl();
    void the_backdrop_looks_the_same_for_every_exposure();
    void the_tone_table_is_the_tone_mapping();
};

void ModelLookTest::a_stopped_brdf_is_a_black_shape_on_grey() {
    Bench bench;
    bench.begin();
    bench.change([](ModelView& view) { view.brdf_runs = false; });
    const Film stopped = paint(bench.scene, 1);
    QVERIFY(is_black(middle(stopped)));
    const QColor corner(ToneTable(kThesisLook).develop(stopped, 1).pixel(2, 2));
    QVERIFY2(corner.lightness() > 140 && corner.lightness() < 190, qPrintable(corner.name()));
    QCOMPARE(corner.hslSaturation(), 0);

    bench.change([](ModelView& view) { view.brdf_runs = true; });
    QVERIFY(luminance(middle(paint(bench.scene, 1))) > 0.01);
}

void ModelLookTest::metal_tints_its_highlight() {
    Bench bench;
    bench.begin();
    bench.set("roughness", 0.3);
    bench.set("albedo-g", 0.2);
    bench.set("albedo-b", 0.2);
    bench.set("metallic", 0);
    const Rgb plastic = brightest(paint(bench.scene)).mean;
    bench.set("metallic", 1);
    const Rgb metal = brightest(paint(bench.scene)).mean;
    QVERIFY2(plastic.g / plastic.r > 0.5, "the highlight of a non-metal is nearly white");
    QVERIFY2(metal.g / metal.r < 0.3, "that of a metal has its colour");
    QVERIFY2(metal.r > 3 * plastic.r, "and is much brighter");
}

void ModelLookTest::roughness_spreads_the_highlight() {
    Bench bench;
    bench.begin();
    bench.set("roughness", 0.2);
    const Film low = paint(bench.scene);
    bench.set("roughness", 0.9);
    const Film high = paint(bench.scene);
    QVERIFY(highlight_size(high) > 4 * highlight_size(low));
    QVERIFY(luminance(brightest(low).mean) > 10 * luminance(brightest(high).mean));
}

void ModelLookTest::albedo_colours_each_channel_apart() {
    Bench bench;
    bench.begin();
    bench.set("roughness", 0.8);
    const Rgb white = middle(paint(bench.scene));
    bench.set("albedo-g", 0);
    bench.set("albedo-b", 0);
    const Rgb red = middle(paint(bench.scene));
    QCOMPARE(red.r, white.r);
    QVERIFY(red.g < 0.05 * red.r);  // what is left is Fresnel's, at the edge of all metals
    QCOMPARE(red.g, red.b);
}

/// A sphere that wears a small measurement, which is kept in `folder`, once it is ready.
void wear_simulated(Bench& bench, const QTemporaryDir& folder, double normalize_factor) {
    const std::string file = folder.filePath("small.asperity").toStdString();
    io::save_measurement(small_measurement(), file);
    bench.begin();
    bench.change([&](ModelView& view) {
        view.brdf.type = BrdfType::Simulated;
        view.brdf.normalize_factor = normalize_factor;
        view.brdf.result = view.second.result = file;
    });
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().message().isEmpty(), 30000);
}

void ModelLookTest::normalize_factor_doubles_the_picture_exactly() {
    const QTemporaryDir folder;
    Bench bench;
    wear_simulated(bench, folder, 1);
    const Film once = paint(bench.scene);
    const Bsdf* baked = &bench.scene.stage().sight()->scene.material.brdf();
    QVERIFY(luminance(middle(once)) > 0);

    bench.set("normalize-factor", 2);
    QVERIFY2(bench.scene.stage().message().isEmpty(), "nothing is made anew");
    QCOMPARE(&bench.scene.stage().sight()->scene.material.brdf(), baked);
    const Film twice = paint(bench.scene);
    // Well within the sphere, whose picture has a radius of 29 pixels
    constexpr int kReach = 16;
    for (int y = kSmall.height() / 2 - kReach; y < kSmall.height() / 2 + kReach; ++y)
        for (int x = kSmall.width() / 2 - kReach; x < kSmall.width() / 2 + kReach; ++x)
            QVERIFY(twice.at(x, y).mean == 2 * once.at(x, y).mean);
}

void ModelLookTest::diffuse_albedo_adds_its_colour() {
    const QTemporaryDir folder;
    Bench bench;
    wear_simulated(bench, folder, 0);
    QVERIFY(is_black(middle(paint(bench.scene))));
    bench.set("diffuse-b", 0.5);
    const Rgb blue = middle(paint(bench.scene));
    QVERIFY(blue.b > 0.1);
    QCOMPARE(blue.r, 0.0);
    QCOMPARE(blue.g, 0.0);
}

void ModelLookTest::both_sides_of_the_split_are_the_whole_pictures() {
    Bench bench;
    bench.begin();
    BrdfSettings dull;
    dull.settings["cook-torrance"] = {
        {"roughness", "0.9"}, {"metallic", "0"}, {"albedo", "0.2/0.4/0.8"}};
    const Film left = paint(bench.scene);
    const BrdfSettings shiny = bench.workbench.settings().model_view.brdf;
    bench.change([&](ModelView& view) { view.brdf = dull; });
    const Film right = paint(bench.scene);
    QVERIFY(!same(left, right));
    bench.change([&](ModelView& view) {
        view.brdf = shiny;
        view.second = dull;
        view.compare = true;
        view.split = 0.4;
    });
    const Film both = paint(bench.scene);
    for (int y = 0; y < both.height(); ++y)
        for (int x = 0; x < both.width(); ++x) {
            const Film& whole = x + 0.5 < 0.4 * both.width() ? left : right;
            QVERIFY(both.at(x, y).mean == whole.at(x, y).mean);
        }
}

void ModelLookTest::light_moves_and_fades() {
    Bench bench;
    bench.begin();
    bench.set("roughness", 0.8);
    const Film bright = paint(bench.scene);
    bench.set("light-intensity", 20);
    const Film dim = paint(bench.scene);
    QCOMPARE(middle(dim).r, 0.5 * middle(bright).r);
    bench.set("light-x", -1);
    const Film from_left = paint(bench.scene);
    const auto side = [](const Film& film, int x) {
        return luminance(film.at(x, film.height() / 2).mean);
    };
    const int left = kSmall.width() / 2 - 15, right = kSmall.width() / 2 + 15;
    QVERIFY(side(dim, right) > 2 * side(dim, left));
    QVERIFY(side(from_left, left) > 2 * side(from_left, right));
}

void ModelLookTest::the_sky_is_seen_and_its_sun_moves() {
    Bench bench;
    bench.begin();
    bench.set("roughness", 0.8);
    bench.find<QComboBox>("light-kind")->setCurrentText("Sky");
    QTRY_VERIFY_WITH_TIMEOUT(!bench.scene.stage().sight()->backdrop, 60000);
    const Rgb above = paint(bench.scene, 1).at(kSmall.width() / 2, 1).mean;
    QVERIFY2(above.b > above.r, "the sky is blue");

    // The sun to the right, then to the left of the model
    const int left = kSmall.width() / 2 - 15, right = kSmall.width() / 2 + 15;
    const auto share_of_left = [&] {
        const Film film = paint(bench.scene, 16);
        const double l = luminance(film.at(left, kSmall.height() / 2).mean);
        const double r = luminance(film.at(right, kSmall.height() / 2).mean);
        return l / (l + r);
    };
    const auto lights = [&] { return bench.scene.stage().sight()->scene.lights; };
    auto before = lights();
    bench.set("sun-azimuth", 90);
    QTRY_VERIFY_WITH_TIMEOUT(lights() != before, 60000);
    QVERIFY(share_of_left() < 0.4);
    before = lights();
    bench.set("sun-azimuth", 270);
    QTRY_VERIFY_WITH_TIMEOUT(lights() != before, 60000);
    QVERIFY(share_of_left() > 0.6);
}

void ModelLookTest::reflections_light_a_bowl() {
    Bench bench;
    bench.begin("bowl");
    const auto sum = [](const Film& film) {
        double all = 0;
        for (const Pixel& pixel : film.pixels()) all += luminance(pixel.mean);
        return all;
    };
    const double direct = sum(paint(bench.scene, 8));
    bench.find<QSpinBox>("depth")->setValue(4);
    QVERIFY(sum(paint(bench.scene, 8)) > 1.02 * direct);
}

void ModelLookTest::the_backdrop_looks_the_same_for_every_exposure() {
    Bench bench;
    bench.begin();
    bench.change([](ModelView& view) { view.brdf_runs = false; });
    QList<QRgb> seen;
    for (const double exposure : {-8.0, 0.0, 5.0})
        for (const ToneCurve curve : {ToneCurve::None, ToneCurve::Reinhard, ToneCurve::Aces}) {
            const ToneMapping tone{exposure, curve, Transfer::Srgb};
            bench.change([&](ModelView& view) { view.tone = tone; });
            const QImage image = ToneTable(tone).develop(paint(bench.scene, 1), 1);
            seen << image.pixel(10, 5);
        }
    for (const QRgb colour : seen) QVERIFY(std::abs(qRed(colour) - qRed(seen[0])) <= 1);
}

void ModelLookTest::the_tone_table_is_the_tone_mapping() {
    Image row{4096, 1, std::vector<float>(3 * 4096)};
    for (std::size_t k = 0; k < row.rgb.size(); ++k)
        row.rgb[k] = static_cast<float>(
            std::exp2(-20 + 40.0 * static_cast<double>(k) / static_cast<double>(row.rgb.size())));
    row.rgb[0] = -1;
    row.rgb[1] = std::numeric_limits<float>::quiet_NaN();
    row.rgb[2] = std::numeric_limits<float>::infinity();
    row.rgb[3] = std::numeric_limits<float>::denorm_min();
    for (const double exposure : {-3.0, 0.0, 2.5})
        for (const ToneCurve curve : {ToneCurve::None, ToneCurve::Reinhard, ToneCurve::Aces})
            for (const Transfer transfer : {Transfer::Srgb, Transfer::Gamma22, Transfer::Linear}) {
                const ToneMapping tone{exposure, curve, transfer};
                const ToneTable table(tone);
                const auto bytes = to_bytes(tone, row);
                for (std::size_t k = 0; k < bytes.size(); ++k)
                    QCOMPARE(table.level(row.rgb[k]), bytes[k]);
            }
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::ModelLookTest)
#include "model_look_test.moc"
