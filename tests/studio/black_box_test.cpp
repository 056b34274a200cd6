// SPDX-License-Identifier: Apache-2.0
// The black-box tests of thesis section 4.3.1, row by row: the real widgets are driven, and the
// effect is checked, not the click. Rows of the model scene: black_box_model_test.cpp.
#include "studio_window.h"

#include "view/run_test_dialog.h"
#include "view/surface_scene.h"

#include <QLabel>
#include <QPlainTextEdit>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace asperity::studio::testing {

class BlackBoxTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup() { window_.reset(); }

    void change_surface_size();
    void change_surface_roughness();
    void change_texture_resolution();
    void update_camera_jittering();
    void increase_ray_bounces();
    void switch_current_layers();
    void camera_types();
    void drawing_to_textures_button();
    void clear_textures_button();
    void perfect_reflection();
    void scattered_reflection();
    void statistics();
    void run_test();

  private:
    StudioWindow& window() { return *window_; }
    const Layer& layer(int number) {
        return *window().workbench().drawing().layers().layer(number);
    }
    const Measurement& result() { return *window().workbench().drawing().result(); }

    TestScope scope_;
    std::unique_ptr<StudioWindow> window_;
};

namespace {

/// Energies of the cells, all orders and channels together, as shares of what was launched.
std::vector<double> cells_of(const Measurement& m, const Layer& layer) {
    std::vector<double> cells(static_cast<std::size_t>(m.detector.cells()));
    for (int cell = 0; cell < m.detector.cells(); ++cell)
        cells[static_cast<std::size_t>(cell)] = m.energy(layer, 0, cell);
    return cells;
}

}  // namespace

void BlackBoxTest::init() {
    window_ = std::make_unique<StudioWindow>();
    window().set_small();
    QVERIFY(window().surface_comes());
}

void BlackBoxTest::change_surface_size() {
    window().type("surface-size", 512);
    QCOMPARE(window().workbench().surface().surface()->nx, 120);  // not before Apply Size
    window().click("apply-size");
    QVERIFY(window().surface_comes());
    QCOMPARE(window().workbench().surface().surface()->nx, 512);
    QCOMPARE(window().workbench().surface().surface()->ny, 512);
    QVERIFY(window().text("statistics-text").contains("Unique triangle count: 524288"));

    window().type("surface-size", 120);
    window().click("apply-size");
    QVERIFY(window().surface_comes());
    QCOMPARE(window().workbench().surface().surface()->nx, 120);
    QCOMPARE(window().workbench().surface().surface()->ny, 120);
    QVERIFY(window().text("statistics-text").contains("Unique triangle count: 28800"));
}

void BlackBoxTest::change_surface_roughness() {
    window().control<QSlider>("surface-roughness-slider").setValue(0);
    QVERIFY(window().surface_comes());
    QVERIFY(window().picture_comes());
    const auto flat = window().workbench().surface().surface();
    const auto [low, high] = std::minmax_element(flat->heights.begin(), flat->heights.end());
    QCOMPARE(*low, *high);
    const double green_when_flat = share_of(window().picture(), is_green);
    QVERIFY2(green_when_flat > 0.02, qPrintable(QString::number(green_when_flat)));

    window().type("surface-roughness", 1);
    QVERIFY(window().surface_comes());
    QVERIFY(window().picture_comes());
    const auto rough = window().workbench().surface().surface();
    const auto [lowest, highest] =
        std::minmax_element(rough->heights.begin(), rough->heights.end());
    QVERIFY(*highest - *lowest > 9.9F);
    QVERIFY(*highest - *lowest <= 10.0F);
    QVERIFY(share_of(window().picture(), is_green) < 0.3 * green_when_flat);
}

void BlackBoxTest::change_texture_resolution() {
    for (const int size : {128, 32}) {
        window().choose("texture-resolution", QString("%1x%1").arg(size));
        QVERIFY(window().text("statistics-text").contains(QString("Resolution: %1x%1").arg(size)));
        QVERIFY(window().draw());
        QCOMPARE(result().detector.columns(), size);
        QCOMPARE(result().detector.rows(), size / 2);
        for (int number = 1; number <= 15; ++number)
            QCOMPARE(layer(number).stderr_energy.size(), static_cast<std::size_t>(size * size / 2));
    }
}

void BlackBoxTest::update_camera_jittering() {
    window().type("camera-jitter", 1);
    QVERIFY(window().draw());
    QCOMPARE(layer(15).rays, std::uint64_t{120 * 120});
    const double error_once = layer(15).stderr_albedo.at(0);
    const auto once = layer(15).energy;

    window().type("camera-jitter", 16);
    QVERIFY(window().draw());
    QCOMPARE(layer(15).rays, std::uint64_t{16 * 120 * 120});
    QVERIFY(layer(15).energy != once);
    QVERIFY(layer(15).stderr_albedo.at(0) < error_once);
}

void BlackBoxTest::increase_ray_bounces() {
    window().type("surface-roughness", 1);
    double former = 0;
    for (const int bounces : {1, 2, 10}) {
        window().type("ray-bounces", bounces);
        QVERIFY(window().draw());
        const double escaped = result().albedo(layer(15), 0);
        QVERIFY2(escaped > 1.3 * former, qPrintable(QString::number(escaped)));
        former = escaped;
    }
}

void BlackBoxTest::switch_current_layers() {
    QVERIFY(window().draw());
    window().type("current-layer", 15);
    QVERIFY(window().picture_comes());
    const QImage from_above = window().picture();
    window().control<QSlider>("current-layer-slider").setValue(1);
    QCOMPARE(window().workbench().settings().surface_view.current_layer, 1);
    QVERIFY(window().picture_comes());
    const QImage grazing = window().picture();
    QVERIFY(difference(from_above, grazing) > 0.05);
    // Layer 1 lies 6 degrees above the horizon, layer 15 in the zenith
    QVERIFY(std::abs(layer(1).theta_i - 84 * kPi / 180) < 1e-9);
    QVERIFY(std::abs(layer(15).theta_i) < 1e-9);
}

void BlackBoxTest::camera_types() {
    Viewport& viewport = window().surface_scene().viewport();
    viewport.setFocus();
    const auto hold_key = [&](Qt::Key key) {
        QTest::keyPress(&viewport, key);
        QTest::qWait(150);
        QTest::keyRelease(&viewport, key);
        QTest::qWait(50);
    };
    const auto drag = [&](Qt::MouseButton button) {
        const QPoint from = viewport.rect().center(), to = from + QPoint(60, 25);
        QTest::mousePress(&viewport, button, {}, from);
        for (const QPoint& place : {from + QPoint(20, 10), from + QPoint(40, 15), to}) {
            QMouseEvent move(QEvent::MouseMove, place, viewport.mapToGlobal(place), Qt::NoButton,
                             button, {});
            QApplication::sendEvent(&viewport, &move);
            QTest::qWait(20);
        }
        QTest::mouseRelease(&viewport, button, {}, to);
        QTest::qWait(50);
    };
    const auto moved = [](Vec3 a, Vec3 b) { return length(a - b) > 1e-3; };

    window().choose("camera-type", "Orbiter");
    Camera before = viewport.camera();
    hold_key(Qt::Key_W);
    QVERIFY(!moved(viewport.camera().position, before.position));  // keys do nothing
    drag(Qt::LeftButton);
    QVERIFY(moved(viewport.camera().position, before.position));
    // It still looks at the same place: both lines of sight meet
    const Vec3 normal = normalize(cross(before.forward, viewport.camera().forward));
    QVERIFY(std::abs(dot(normal, viewport.camera().position - before.position)) < 1e-9);

    window().choose("camera-type", "First-Person");
    viewport.setFocus();
    before = viewport.camera();
    hold_key(Qt::Key_W);
    QVERIFY(moved(viewport.camera().position, before.position));
    before = viewport.camera();
    drag(Qt::LeftButton);  // looks around without moving
    QVERIFY(!moved(viewport.camera().position, before.position));
    QVERIFY(moved(viewport.camera().forward, before.forward));

    window().choose("camera-type", "6-DoF");
    viewport.setFocus();
    before = viewport.camera();
    drag(Qt::RightButton);  // rolls
    QVERIFY(!moved(viewport.camera().position, before.position));
    QVERIFY(moved(viewport.camera().up, before.up));
    hold_key(Qt::Key_A);
    QVERIFY(moved(viewport.camera().position, before.position));
}

void BlackBoxTest::drawing_to_textures_button() {
    QVERIFY(window().picture_comes());
    const QImage empty = window().picture();
    std::vector<int> order;
    connect(&window().workbench().drawing(), &Drawing::layers_changed, this, [&](int number) {
        if (number > 0 && (order.empty() || order.back() != number)) order.push_back(number);
    });
    QVERIFY(window().draw());
    std::vector<int> descending(15);
    std::iota(descending.rbegin(), descending.rend(), 1);
    QCOMPARE(order, descending);

    QVERIFY(window().picture_comes());
    const double dome = share_of(window().picture(), is_warm) - share_of(empty, is_warm);
    QVERIFY2(dome > 0.1, qPrintable(QString::number(dome)));
}

void BlackBoxTest::clear_textures_button() {
    QVERIFY(window().picture_comes());
    const QImage empty = window().picture();
    QVERIFY(window().draw());
    QVERIFY(window().picture_comes());
    QVERIFY(difference(window().picture(), empty) > 0.1);

    window().click("clear-textures");
    QVERIFY(window().workbench().drawing().layers().by_number.empty());
    QVERIFY(window().picture_comes());
    QVERIFY(difference(window().picture(), empty) < 0.01);
    QVERIFY(!window().control<QPushButton>("clear-textures").isEnabled());
}

void BlackBoxTest::perfect_reflection() {
    window().type("surface-roughness", 0);
    QVERIFY(window().draw());
    for (int number = 1; number <= 15; ++number) {
        const Layer& now = layer(number);
        const double theta = now.theta_i;
        const std::vector<double> cells = cells_of(result(), now);
        const int brightest =
            static_cast<int>(std::max_element(cells.begin(), cells.end()) - cells.begin());
        QCOMPARE(cells[static_cast<std::size_t>(brightest)], 1.0);
        // In the mirror direction: light from azimuth 0 leaves at 180 degrees
        const Vec3 mirror{-std::sin(theta), 0, std::cos(theta)};
        QVERIFY(dot(result().detector.centre(brightest), mirror) > std::cos(0.1));
    }
}

void BlackBoxTest::scattered_reflection() {
    window().type("surface-roughness", 1);
    window().type("ray-bounces", 16);
    window().type("camera-jitter", 8);
    QVERIFY(window().draw());
    const std::vector<double> cells = cells_of(result(), layer(15));
    QVERIFY(*std::max_element(cells.begin(), cells.end()) < 0.02);
    const auto lit = std::count_if(cells.begin(), cells.end(), [](double e) { return e > 0; });
    QVERIFY(lit > static_cast<long>(cells.size()) * 9 / 10);
}

void BlackBoxTest::statistics() {
    QVERIFY(window().picture_comes());
    QVERIFY(window().draw());
    const QString text = window().text("statistics-text");
    for (const char* line :
         {"Frame Stats: ", "Mesh count: 14400", "Mesh instance count (total): 14400",
          "Transform matrix count: 14401", "Unique triangle count: 28800",
          "Unique vertex count: 57600", "Instanced triangle count: 28800",
          "Instanced vertex count: 57600", "Resolution: 64x64", "Rays Count: 216000"})
        QVERIFY2(text.contains(line), qPrintable(QString(line) + " is not in\n" + text));

    window().click("print-to-log");
    const QStringList log = window().workbench().log_lines();
    QVERIFY(log.contains("  Unique triangle count: 28800"));
    QVERIFY(window().findChild<QPlainTextEdit*>("log")->toPlainText().contains(
        "Unique triangle count: 28800"));
}

void BlackBoxTest::run_test() {
    window().click("run-test");
    auto* dialog = window().findChild<RunTestDialog*>();
    QVERIFY(dialog != nullptr && dialog->isVisible());
    QVERIFY(QTest::qWaitFor([&] { return !dialog->busy(); }, 120000));
    QCOMPARE(dialog->findChild<QLabel*>("final-result")->text(), "79 out of 79 Passed");
    QCOMPARE(dialog->findChild<QTreeWidget*>("texture-tests")->topLevelItemCount(), 75);
    QCOMPARE(dialog->findChild<QTreeWidget*>("model-tests")->topLevelItemCount(), 4);

    QTest::mouseClick(dialog->findChild<QPushButton*>("run-again"), Qt::LeftButton);
    QVERIFY(dialog->busy());
    QTest::mouseClick(dialog->findChild<QPushButton*>("exit-test"), Qt::LeftButton);
    QVERIFY(!dialog->busy() && !dialog->isVisible());
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::BlackBoxTest)
#include "black_box_test.moc"
