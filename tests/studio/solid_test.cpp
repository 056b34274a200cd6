// SPDX-License-Identifier: Apache-2.0
// What a user may rely on: nothing moves under the mouse, no false complaint, all can be reached
// without a mouse and by a screen reader, sessions keep cameras, small windows and lectures work.
#include "studio_window.h"

#include "model/first_session.h"
#include "view/file_kinds.h"
#include "view/model_scene.h"
#include "view/plots_panel.h"
#include "view/surface_scene.h"
#include "view/tour.h"

#include <QAccessible>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QFile>
#include <QLabel>
#include <QSignalSpy>

#include <map>
#include <memory>

namespace asperity::studio::testing {

class SolidTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup() { window_.reset(); }

    void buttons_never_move();
    void a_new_session_has_no_model();
    void a_text_file_is_no_builtin_model();
    void no_tour_step_asks_for_textures();
    void statistics_at_rest_say_how_refined();
    void a_click_is_answered_at_once();
    void presentation_shows_the_scene_alone();
    void small_windows_are_usable();
    void sessions_keep_cameras();
    void files_are_told_apart();
    void old_plots_are_marked();
    void every_control_has_a_name();
    void keys_turn_the_camera();
    void home_has_the_whole_dome_in_view();
    void measuring_at_start_can_be_turned_off();
    void surfaces_and_textures_may_be_large();

  private:
    StudioWindow& window() { return *window_; }
    QString write(const QString& name, const QByteArray& text);
    std::map<QString, QPoint> button_places();

    TestScope scope_;
    std::unique_ptr<StudioWindow> window_;
};

void SolidTest::init() {
    window_ = std::make_unique<StudioWindow>();
    window().set_small();
    QVERIFY(window().surface_comes());
}

QString SolidTest::write(const QString& name, const QByteArray& text) {
    QFile file(scope_.path(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) qFatal("no file");
    return file.fileName();
}

std::map<QString, QPoint> SolidTest::button_places() {
    std::map<QString, QPoint> places;
    auto* page = window().findChild<QWidget*>("surface-page");
    for (QPushButton* button : page->findChildren<QPushButton*>())
        if (button->isVisible() && button->objectName() != "view-model")
            places[button->objectName()] = button->mapTo(window_.get(), QPoint(0, 0));
    return places;
}

void SolidTest::buttons_never_move() {
    QTest::qWait(100);
    const auto before = button_places();
    QVERIFY(before.size() >= 7);
    window().type("camera-jitter", 4096);
    window().click("draw-to-textures");
    QVERIFY(window().workbench().is_drawing());
    QTest::qWait(300);
    QCOMPARE(button_places(), before);  // beside the progress
    window().click("stop-drawing");
    window().type("camera-jitter", 1);
    QVERIFY(window().draw());
    window().type("ray-bounces", 7);
    QTest::qWait(100);
    QVERIFY(window().control<QLabel>("layers-hint").isVisible());
    QCOMPARE(button_places(), before);  // beside the hint
    window().load_model("plane");
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 30000));
    window().view(SceneKind::Surface);
    QTest::qWait(100);
    QVERIFY(window().control<QPushButton>("view-model").isVisible());
    QCOMPARE(button_places(), before);
}

void SolidTest::a_new_session_has_no_model() {
    window().load_model("plane");
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 30000));
    window().new_session();
    QVERIFY(window().surface_comes());
    QVERIFY(!window().control<QPushButton>("view-model").isVisible());
    QVERIFY(!window().model_scene().has_model());
}

void SolidTest::a_text_file_is_no_builtin_model() {
    QSignalSpy complaints(&window().workbench(), &Workbench::complaint);
    window().load_model(write("notes.txt", "milk, bread\n"));
    QVERIFY(QTest::qWaitFor([&] { return complaints.count() == 1; }, 10000));
    const QString sentence = complaints.first().first().toString();
    QVERIFY2(sentence.contains("notes.txt") && sentence.contains(".obj"), qPrintable(sentence));
    QVERIFY2(!sentence.contains("knot"), qPrintable(sentence));
}

void SolidTest::no_tour_step_asks_for_textures() {
    window().begin(false);
    QSignalSpy complaints(&window().workbench(), &Workbench::complaint);
    window().tour().begin();
    for (int step = 0; step < Tour::step_count(); ++step) {
        window().tour().show_step(step);
        QVERIFY(QTest::qWaitFor([this] { return !window().workbench().is_drawing(); }, 120000));
        QVERIFY(window().workbench().are_layers_current());
    }
    for (const auto& complaint : complaints) qWarning("%s", qPrintable(complaint[0].toString()));
    QCOMPARE(complaints.count(), 0);
}

void SolidTest::statistics_at_rest_say_how_refined() {
    QVERIFY(window().picture_comes());
    QVERIFY(QTest::qWaitFor([this] { return window().viewport().frame().passes == 16; }, 20000));
    QVERIFY(window().text("statistics-text").startsWith("Frame Stats: refined, 16 samples\n"));
}

void SolidTest::a_click_is_answered_at_once() {
    QVERIFY(window().draw());
    QVERIFY(window().picture_comes());
    LightSeen& light = window().workbench().light();
    // A cell that no light reaches: all paths are looked at before that is known
    const Detector detector(window().workbench().settings().experiment.detector);
    const int cell = detector.cell_of({0.05, 0.02, 0.99});
    QElapsedTimer clock;
    clock.start();
    window().workbench().select_cell(cell);
    const QString reading = window().text("layers-hint");
    const QImage now = window().picture();
    const qint64 answered = clock.elapsed();
    QCOMPARE(window().workbench().selected_cell(), std::optional(cell));
    QVERIFY(!now.isNull());
    qInfo("a click is answered after %lld ms", static_cast<long long>(answered));
    QVERIFY(QTest::qWaitFor([&] { return !light.busy(); }, 60000));
}

void SolidTest::presentation_shows_the_scene_alone() {
    const int letters = window().viewport().fontMetrics().height();
    QTest::keyClick(window_.get(), Qt::Key_F9);
    QTest::qWait(200);
    QVERIFY(window().is_presenting());
    for (QDockWidget* dock : window().findChildren<QDockWidget*>()) QVERIFY(!dock->isVisible());
    QCOMPARE(window().surface_scene().width(), window().width());
    QVERIFY(window().viewport().fontMetrics().height() > letters * 3 / 2);
    QTest::keyClick(&window().viewport(), Qt::Key_Escape);
    QTest::qWait(200);
    QVERIFY(!window().is_presenting());
    QVERIFY(window().findChild<QDockWidget*>("menu-dock")->isVisible());
    QCOMPARE(window().viewport().fontMetrics().height(), letters);
}

void SolidTest::small_windows_are_usable() {
    window().resize(1024, 640);
    QTest::qWait(200);
    QCOMPARE(window().size(), QSize(1024, 640));
    for (QDockWidget* dock : window().findChildren<QDockWidget*>())
        qInfo("%s %d of at least %d", qPrintable(dock->objectName()), dock->width(),
              dock->minimumSizeHint().width());
    qInfo("at 1024 x 640 the picture is %d x %d", window().viewport().width(),
          window().viewport().height());
    QVERIFY(window().viewport().width() >= 300 && window().viewport().height() >= 400);
    for (const auto& [name, place] : button_places())
        QVERIFY2(QRect(0, 0, 1024, 640).contains(place), qPrintable(name));
    QVERIFY(window().plots().isVisible());
}

void SolidTest::sessions_keep_cameras() {
    QTest::keyClick(&window().viewport(), Qt::Key_Left);
    QTest::keyClick(&window().viewport(), Qt::Key_Plus);
    const Camera moved = window().viewport().camera();
    const QString path = scope_.path("cameras.conf");
    window().save_session();  // never saved: asks for a name
    window().workbench().document().save(path);
    QVERIFY(!window().workbench().document().modified());
    window().new_session();
    QVERIFY(length(window().viewport().camera().position - moved.position) > 0.1);
    window().open(path);
    const Camera found = window().viewport().camera();
    QVERIFY(length(found.position - moved.position) < 1e-6);
    QVERIFY(length(found.forward - moved.forward) < 1e-6);
    // A new session begins where sessions begin
    window().new_session();
    QVERIFY(length(window().viewport().camera().position - moved.position) > 0.1);
}

void SolidTest::files_are_told_apart() {
    QCOMPARE(kind_of_file(write("a.txt", "1 2 3\n4 5 6\n")), FileKind::Surface);
    QCOMPARE(kind_of_file(write("b.txt", "# kept\nsurface = thesis\n")), FileKind::Session);
    QCOMPARE(kind_of_file(write("c.conf", "size = 120\n")), FileKind::Session);
    QCOMPARE(kind_of_file(write("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), FileKind::Model);
    for (const char* part : {"*.asperity", "*.conf", "*.gsf", "*.sur", "*.obj", "*.glb"})
        QVERIFY2(open_filter().section(";;", 0, 0).contains(part), part);
}

void SolidTest::old_plots_are_marked() {
    auto& mark = window().control<QLabel>("stale-plot");
    QVERIFY(window().draw());
    QTest::qWait(500);
    QVERIFY(!mark.isVisible());
    window().type("ray-bounces", 9);
    QVERIFY(QTest::qWaitFor([&] { return mark.isVisible(); }, 60000));
    QVERIFY(window().draw());
    QVERIFY(QTest::qWaitFor([&] { return !mark.isVisible(); }, 60000));
}

void SolidTest::every_control_has_a_name() {
    window().load_model("plane");
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 30000));
    QStringList nameless;
    for (QWidget* widget : window().findChildren<QWidget*>()) {
        if (widget->focusPolicy() == Qt::NoFocus || (widget->focusPolicy() & Qt::TabFocus) == 0)
            continue;
        // Parts of Qt's own controls, the lists of boxes that open in a window of their own
        if (widget->objectName().startsWith("qt_") || widget->window() != window_.get()) continue;
        QAccessibleInterface* seen = QAccessible::queryAccessibleInterface(widget);
        if (seen == nullptr || seen->text(QAccessible::Name).isEmpty())
            nameless << QString("%1 %2").arg(widget->metaObject()->className(),
                                             widget->objectName());
    }
    QVERIFY2(nameless.isEmpty(), qPrintable(nameless.join("\n")));
}

void SolidTest::keys_turn_the_camera() {
    Viewport& view = window().viewport();
    const Camera before = view.camera();
    QTest::keyClick(&view, Qt::Key_Right);
    const Camera turned = view.camera();
    QVERIFY(length(turned.position - before.position) > 0.1);
    QVERIFY(std::abs(length(turned.position) - length(before.position)) < 0.5);
    QTest::keyClick(&view, Qt::Key_Plus);
    const Vec3 target{0, 0.55, 0};
    QVERIFY(length(view.camera().position - target) < 0.95 * length(turned.position - target));
    QTest::keyClick(&view, Qt::Key_R);
    QVERIFY(length(view.camera().position - before.position) < 1e-9);
}

void SolidTest::home_has_the_whole_dome_in_view() {
    window().begin(false);
    for (const QSize size : {QSize(1280, 800), QSize(1920, 1080), QSize(1024, 640)}) {
        window().resize(size);
        QVERIFY(window().picture_comes());
        const QRectF view = window().viewport().rect();
        for (int k = 0; k < 36; ++k) {
            const double angle = radians(10 * k);
            const Vec3 horizon = kDomeRadius * Vec3{std::cos(angle), 0, std::sin(angle)};
            const Vec3 arc = kDomeRadius * Vec3{std::cos(angle / 2), std::sin(angle / 2), 0};
            for (const Vec3 point : {horizon, arc}) {
                const std::optional<QPointF> place = window().viewport().project(point);
                QVERIFY(place && view.contains(*place));
            }
        }
    }
}

void SolidTest::measuring_at_start_can_be_turned_off() {
    window().begin(false);
    QVERIFY(window().surface_comes());
    QVERIFY(!window().workbench().is_drawing());
    QCOMPARE(window().workbench().settings().experiment.optics.material, std::string("Au"));
    window().begin(true);
    QVERIFY(window().workbench().is_drawing());
    window().workbench().stop_drawing();
}

// 4096 samples on a side, of the thesis' noise too, and layers of 4096 x 2048 cells.
void SolidTest::surfaces_and_textures_may_be_large() {
    constexpr int kLarge = 4096;
    window().type("surface-size", kLarge);
    window().click("apply-size");
    QVERIFY(window().surface_comes());
    QCOMPARE(window().workbench().settings().experiment.surface.kind, "thesis");
    QCOMPARE(window().workbench().surface().surface()->nx, kLarge);
    QCOMPARE(window().workbench().surface().surface()->ny, kLarge);
    QVERIFY(window().text("statistics-text").contains("Unique triangle count: 33554432"));
    QVERIFY(window().picture_comes());

    // Rays as for a small surface: it is the layers that are large here
    window().type("surface-size", 120);
    window().click("apply-size");
    QVERIFY(window().surface_comes());
    auto& sizes = window().control<QComboBox>("texture-resolution");
    sizes.setCurrentIndex(sizes.findData(kLarge));
    QCOMPARE(window().workbench().settings().experiment.detector.resolution, kLarge);
    window().click("draw-to-textures");
    const Drawing& drawing = window().workbench().drawing();
    QTRY_VERIFY_WITH_TIMEOUT(!drawing.layers().by_number.empty(), 60000);
    QCOMPARE(drawing.layers().head->detector.cells(), kLarge * kLarge / 2);
    QVERIFY(window().text("statistics-text").contains("Resolution: 4096x4096"));
    QVERIFY(window().picture_comes());
    window().click("stop-drawing");
    QVERIFY(QTest::qWaitFor([this] { return !window().workbench().is_drawing(); }, 60000));
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::SolidTest)
#include "solid_test.moc"
