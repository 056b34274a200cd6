// SPDX-License-Identifier: Apache-2.0
// The rows of thesis section 4.3.1 that are about the model scene, as black_box_test.cpp.
#include "studio_window.h"

#include "view/model_scene.h"
#include "view/surface_scene.h"

#include <memory>

namespace asperity::studio::testing {

class BlackBoxModelTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup() { window_.reset(); }

    void view_model();
    void brdf_type();
    void cook_torrance_brdf();
    void simulated_brdf();
    void start_simulation_button();
    void stop_simulation_button();
    void view_surface();

  private:
    StudioWindow& window() { return *window_; }
    void show_model();

    TestScope scope_;
    std::unique_ptr<StudioWindow> window_;
};

void BlackBoxModelTest::init() {
    window_ = std::make_unique<StudioWindow>();
    window().set_small();
    QVERIFY(window().surface_comes());
}

void BlackBoxModelTest::show_model() {
    window().load_model("sphere");
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 60000));
    QVERIFY(window().picture_comes());
}

void BlackBoxModelTest::view_model() {
    QVERIFY(!window().control<QPushButton>("view-model").isVisible());  // there is no model yet
    show_model();
    QVERIFY(window().model_scene().isVisible());
    window().click("view-surface");
    QVERIFY(!window().model_scene().isVisible());
    QVERIFY(window().control<QPushButton>("view-model").isVisible());
    window().click("view-model");
    QVERIFY(window().model_scene().isVisible());
    QVERIFY(window().text("statistics-text").contains("Unique triangle count: 261120"));
}

void BlackBoxModelTest::brdf_type() {
    show_model();
    auto& metallic = window().control<QWidget>("metallic");
    auto& factor = window().control<QWidget>("normalize-factor");
    window().choose("brdf-type", "Cook-Torrance");
    QVERIFY(metallic.isVisible() && !factor.isVisible());
    window().choose("brdf-type", "Simulated");
    QVERIFY(!metallic.isVisible() && factor.isVisible());
}

void BlackBoxModelTest::cook_torrance_brdf() {
    show_model();
    window().choose("brdf-type", "Cook-Torrance");
    window().click("start-brdf");
    window().type("roughness", 0.2);
    window().type("metallic", 1);
    QVERIFY(window().picture_comes());
    const QImage smooth = window().picture();
    const auto is_dark = [](const QColor& c) { return c.green() < 60; };

    // A rougher metal has a wider highlight
    window().type("roughness", 0.6);
    QVERIFY(window().picture_comes());
    const QImage rough = window().picture();
    QVERIFY(difference(smooth, rough) > 0.01);
    QVERIFY(share_of(rough, is_dark) < share_of(smooth, is_dark) - 0.01);

    // What is no metal is lit diffusely, all over the lit side
    window().type("metallic", 0);
    QVERIFY(window().picture_comes());
    const QImage plastic = window().picture();
    QVERIFY(difference(rough, plastic) > 0.02);

    // An albedo without green and blue
    window().type("albedo-g", 0);
    window().type("albedo-b", 0);
    QVERIFY(window().picture_comes());
    const double red = share_of(window().picture(), is_reddish);
    QVERIFY2(red > 0.05, qPrintable(QString::number(red)));
    QVERIFY(share_of(plastic, is_reddish) < 0.001);
}

void BlackBoxModelTest::simulated_brdf() {
    window().type("surface-roughness", 0.1);
    QVERIFY(window().draw());
    show_model();
    window().choose("brdf-type", "Simulated");
    QVERIFY(window().picture_comes());
    const QImage stopped = window().picture();
    window().click("start-brdf");
    QVERIFY(QTest::qWaitFor(
        [&] { return window().picture_comes() && difference(window().picture(), stopped) > 0.02; },
        60000));
    const double black = share_of(window().picture(), is_black);

    // The factor darkens the highlight, the albedo gives the model a colour
    const QImage right = window().picture();
    window().type("normalize-factor", 0.2);
    QVERIFY(window().picture_comes());
    QVERIFY(difference(window().picture(), right) > 0.01);
    window().type("diffuse-r", 0.8);
    QVERIFY(window().picture_comes());
    QVERIFY(share_of(window().picture(), is_reddish) > 0.05);
    QVERIFY(share_of(window().picture(), is_black) < black);
}

void BlackBoxModelTest::start_simulation_button() {
    show_model();
    const QImage before = window().picture();
    QVERIFY(share_of(before, is_black) > 0.1);  // the black shape of figure 2.13c
    window().click("start-brdf");
    QVERIFY(window().picture_comes());
    QVERIFY(difference(window().picture(), before) > 0.05);
    QVERIFY(!window().control<QPushButton>("start-brdf").isEnabled());
}

void BlackBoxModelTest::stop_simulation_button() {
    show_model();
    const QImage before = window().picture();
    window().click("start-brdf");
    QVERIFY(window().picture_comes());
    window().click("stop-brdf");
    QVERIFY(window().picture_comes());
    QVERIFY(difference(window().picture(), before) < 0.002);
    QVERIFY(!window().control<QPushButton>("stop-brdf").isEnabled());
}

void BlackBoxModelTest::view_surface() {
    show_model();
    window().click("view-surface");
    QVERIFY(window().surface_scene().isVisible());
    QVERIFY(!window().model_scene().isVisible());
    QVERIFY(window().picture_comes());
    QVERIFY(window().control<QPushButton>("draw-to-textures").isVisible());
    QVERIFY(share_of(window().picture(), is_green) > 0.001);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::BlackBoxModelTest)
#include "black_box_model_test.moc"
