// SPDX-License-Identifier: Apache-2.0
// What makes the window a good desktop program: locks, hints, undo, sessions, a quick end.
#include "studio_window.h"

#include "view/preferences.h"

#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFile>
#include <QLabel>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>

#include <functional>
#include <memory>

namespace asperity::studio::testing {

class WindowTest : public QObject {
    Q_OBJECT

  private slots:
    void init() {
        window_ = std::make_unique<StudioWindow>();
        window_->set_small();
        QVERIFY(window_->surface_comes());
    }
    void cleanup() { window_.reset(); }

    void settings_are_locked_while_drawing();
    void tells_when_layers_are_old();
    void pause_and_resume();
    void undo_and_redo_move_the_controls();
    void session_comes_back();
    void damaged_session_is_complained_of();
    void asks_before_a_change_is_lost();
    void closes_at_once_while_drawing();
    void layout_goes_back_to_the_first();
    void presentation_gives_the_layout_back();

  private:
    /// A drawing that takes minutes.
    void draw_long();

    TestScope scope_;
    std::unique_ptr<StudioWindow> window_;
};

void WindowTest::draw_long() {
    window_->type("surface-roughness", 1);
    window_->type("camera-jitter", 4096);
    window_->click("draw-to-textures");
    Drawing& drawing = window_->workbench().drawing();
    QVERIFY(QTest::qWaitFor([&] { return drawing.progress().done > 0; }, 30000));
}

void WindowTest::settings_are_locked_while_drawing() {
    auto& size = window_->control<QWidget>("surface-size");
    auto& bounces = window_->control<QWidget>("ray-bounces");
    const QString tooltip = bounces.toolTip();
    QVERIFY(size.isEnabled() && bounces.isEnabled());
    draw_long();
    QVERIFY(!size.isEnabled() && !bounces.isEnabled());
    QVERIFY(bounces.toolTip().startsWith("Stop Drawing first"));
    QVERIFY(window_->control<QWidget>("current-layer").isEnabled());  // decides nothing
    auto& progress = window_->control<QProgressBar>("drawing-progress");
    QVERIFY(progress.isVisible());
    QVERIFY(QTest::qWaitFor([&] { return progress.format().contains(" left"); }, 10000));

    window_->click("stop-drawing");
    QVERIFY(size.isEnabled() && bounces.isEnabled());
    QCOMPARE(bounces.toolTip(), tooltip);
    QVERIFY(!progress.isVisible());
    QVERIFY(window_->workbench().drawing().layers().by_number.empty());  // ends and clears
}

void WindowTest::tells_when_layers_are_old() {
    auto& hint = window_->control<QLabel>("layers-hint");
    QVERIFY(!hint.isVisible());
    QVERIFY(window_->draw());
    QVERIFY(!hint.isVisible());
    window_->type("ray-bounces", 7);
    QVERIFY(hint.isVisible());
    window_->workbench().document().undo_stack().undo();
    QVERIFY(!hint.isVisible());
}

void WindowTest::pause_and_resume() {
    draw_long();
    Drawing& drawing = window_->workbench().drawing();
    QVERIFY(QTest::qWaitFor([&] { return !drawing.layers().by_number.empty(); }, 60000));
    auto& button = window_->control<QPushButton>("pause-resume");
    QCOMPARE(button.text(), "Pause");
    QTest::mouseClick(&button, Qt::LeftButton);
    QCOMPARE(button.text(), "Resume");
    QTest::qWait(500);  // pieces of work under way end
    const std::uint64_t done = drawing.progress().done;
    QTest::qWait(300);
    QCOMPARE(drawing.progress().done, done);
    QVERIFY(!drawing.layers().by_number.empty());  // kept
    QTest::mouseClick(&button, Qt::LeftButton);
    QVERIFY(QTest::qWaitFor([&] { return drawing.progress().done > done; }, 10000));
}

void WindowTest::undo_and_redo_move_the_controls() {
    auto& roughness = window_->control<QDoubleSpinBox>("surface-roughness");
    const double before = roughness.value();
    window_->type("surface-roughness", 0.7);
    QUndoStack& steps = window_->workbench().document().undo_stack();
    QCOMPARE(steps.undoText(), "Surface Roughness");
    steps.undo();
    QCOMPARE(roughness.value(), before);
    steps.redo();
    QCOMPARE(roughness.value(), 0.7);
}

void WindowTest::session_comes_back() {
    const QString path = scope_.path("mine.conf");
    window_->type("surface-roughness", 0.35);
    window_->type("current-layer", 4);
    window_->workbench().document().save(path);
    QVERIFY(!window_->isWindowModified());
    window_->type("surface-roughness", 0.9);
    QVERIFY(window_->isWindowModified());

    window_->open(path);
    QCOMPARE(window_->control<QDoubleSpinBox>("surface-roughness").value(), 0.35);
    QCOMPARE(window_->control<QDoubleSpinBox>("current-layer").value(), 4.0);
    QVERIFY(!window_->isWindowModified());
    QVERIFY(window_->windowTitle().startsWith("mine.conf"));
    QCOMPARE(preferences::recent_files().value(0), path);
}

void WindowTest::damaged_session_is_complained_of() {
    const QString path = scope_.path("damaged.conf");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("roughness = very\n");
    file.close();
    const double before = window_->control<QDoubleSpinBox>("surface-roughness").value();
    window_->open(path);
    auto* box = window_->findChild<QMessageBox*>("complaint");
    QVERIFY(box != nullptr);
    QVERIFY2(box->text().contains("damaged.conf:1"), qPrintable(box->text()));
    QVERIFY(window_->workbench().log_lines().contains(box->text()));
    QCOMPARE(window_->control<QDoubleSpinBox>("surface-roughness").value(), before);
    box->close();
}

void WindowTest::asks_before_a_change_is_lost() {
    window_->set_asking(MainWindow::Asking::Yes);
    window_->type("surface-roughness", 0.35);
    window_->close();
    QVERIFY(window_->isVisible());
    auto* box = window_->findChild<QMessageBox*>("save-first");
    QVERIFY(box != nullptr && box->isVisible());
    box->button(QMessageBox::Discard)->click();
    QVERIFY(QTest::qWaitFor([this] { return !window_->isVisible(); }, 60000));
}

void WindowTest::closes_at_once_while_drawing() {
    draw_long();
    QElapsedTimer clock;
    clock.start();
    window_->close();
    window_.reset();
    QVERIFY2(clock.elapsed() < 1000, qPrintable(QString::number(clock.elapsed())));
}

void WindowTest::layout_goes_back_to_the_first() {
    auto& menu = window_->control<QDockWidget>("menu-dock");
    auto& plots = window_->control<QDockWidget>("plots-dock");
    auto& log = window_->control<QDockWidget>("log-dock");
    const auto places = [&] { return QList<QRect>{menu.geometry(), plots.geometry()}; };
    const auto first = [&] {
        window_->reset_layout();
        QTest::qWait(50);
        return places();
    }();
    const std::function<void()> upsets[] = {
        [&] { menu.setFloating(true); },
        [&] { window_->addDockWidget(Qt::RightDockWidgetArea, &menu); },
        [&] { window_->tabifyDockWidget(&menu, &plots), log.raise(); },
        [&] { window_->splitDockWidget(&log, &menu, Qt::Vertical); },
        [&] { menu.hide(), plots.hide(), log.hide(); },
    };
    for (const auto& upset : upsets) {
        upset();
        QTest::qWait(50);
        QVERIFY(places() != first || !menu.isVisible());
        window_->reset_layout();
        QTest::qWait(50);
        QCOMPARE(places(), first);
        QVERIFY(menu.isVisible() && !menu.isFloating());
        QVERIFY(!plots.visibleRegion().isEmpty() && !log.isHidden());
        QCOMPARE(window_->tabifiedDockWidgets(&plots), QList<QDockWidget*>{&log});
    }
}

void WindowTest::presentation_gives_the_layout_back() {
    auto& menu = window_->control<QDockWidget>("menu-dock");
    auto& plots = window_->control<QDockWidget>("plots-dock");
    auto& log = window_->control<QDockWidget>("log-dock");
    menu.hide();
    log.raise();
    QTest::qWait(50);
    const QRect place = log.geometry();
    window_->set_presenting(true);
    QTest::qWait(50);
    QVERIFY(!plots.isVisible() && !log.isVisible());
    window_->set_presenting(false);
    QTest::qWait(50);
    QVERIFY(menu.isHidden() && !plots.isHidden());
    QVERIFY(!log.visibleRegion().isEmpty() && plots.visibleRegion().isEmpty());
    QCOMPARE(log.geometry(), place);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::WindowTest)
#include "window_test.moc"
