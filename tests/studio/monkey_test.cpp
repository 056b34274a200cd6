// SPDX-License-Identifier: Apache-2.0
// Ten thousand events without sense, always the same: the window must live through them.
// ASPERITY_MONKEY_EVENTS and ASPERITY_MONKEY_SEED choose other numbers.
#include "studio_window.h"

#include <QAction>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QSpinBox>
#include <QTimer>
#include <QWheelEvent>

#include <algorithm>
#include <random>

namespace asperity::studio::testing {

namespace {

int number_from_environment(const char* name, int otherwise) {
    bool is_number = false;
    const int number = qEnvironmentVariableIntValue(name, &is_number);
    return is_number ? number : otherwise;
}

/// Menus and dialogs that an event opened are closed again: what they hold back is not the window.
void close_what_is_open() {
    if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
    if (QWidget* modal = QApplication::activeModalWidget()) modal->close();
}

}  // namespace

/// Does one thing after the other to a window.
class Monkey {
  public:
    Monkey(StudioWindow& window, unsigned seed) : window_(window), random_(seed) {}

    void act() {
        keep_small();
        switch (below(8)) {
            case 0:
                return press_key();
            case 1:
                return turn_number();
            case 2:
                return choose();
            case 3:
                return trigger();
            case 4:
                return roll();
            case 5:
                return drag();
            default:
                return click();
        }
    }

  private:
    int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    template <typename Widget>
    Widget* any() {
        QList<Widget*> seen;
        for (Widget* widget : window_.findChildren<Widget*>())
            if (widget->isVisible() && widget->isEnabled()) seen << widget;
        return seen.isEmpty() ? nullptr : seen.at(below(static_cast<int>(seen.size())));
    }

    QPoint place_in(const QWidget& widget) {
        return {below(std::max(1, widget.width())), below(std::max(1, widget.height()))};
    }

    void click() {
        QWidget* target = any<QWidget>();
        if (target == nullptr) return;
        const Qt::MouseButton button = below(4) == 0 ? Qt::RightButton : Qt::LeftButton;
        if (below(8) == 0)
            QTest::mouseDClick(target, button, {}, place_in(*target));
        else
            QTest::mouseClick(target, button, {}, place_in(*target));
    }

    void drag() {
        QWidget* target = any<QWidget>();
        if (target == nullptr) return;
        const Qt::MouseButton button = below(3) == 0 ? Qt::RightButton : Qt::LeftButton;
        QTest::mousePress(target, button, {}, place_in(*target));
        for (int i = 0; i < 3; ++i) {
            const QPoint place = place_in(*target);
            QMouseEvent move(QEvent::MouseMove, place, target->mapToGlobal(place), Qt::NoButton,
                             button, {});
            QApplication::sendEvent(target, &move);
        }
        QTest::mouseRelease(target, button, {}, place_in(*target));
    }

    void roll() {
        QWidget* target = any<QWidget>();
        if (target == nullptr) return;
        const QPoint place = place_in(*target);
        QWheelEvent wheel(place, target->mapToGlobal(place), {}, {0, 120 * (below(7) - 3)},
                          Qt::NoButton, {}, Qt::NoScrollPhase, false);
        QApplication::sendEvent(target, &wheel);
    }

    void press_key() {
        static const int keys[] = {Qt::Key_W,    Qt::Key_A,      Qt::Key_S,     Qt::Key_D,
                                   Qt::Key_Q,    Qt::Key_E,      Qt::Key_R,     Qt::Key_Tab,
                                   Qt::Key_Up,   Qt::Key_Down,   Qt::Key_Left,  Qt::Key_Right,
                                   Qt::Key_1,    Qt::Key_5,      Qt::Key_Space, Qt::Key_Return,
                                   Qt::Key_Home, Qt::Key_Escape, Qt::Key_Minus, Qt::Key_Backspace};
        QWidget* target = below(2) == 0 ? any<QWidget>() : QApplication::focusWidget();
        if (target == nullptr) return;
        QTest::keyClick(target, static_cast<Qt::Key>(keys[below(std::size(keys))]),
                        below(6) == 0 ? Qt::ShiftModifier : Qt::NoModifier);
    }

    void turn_number() {
        if (below(2) == 0) {
            if (auto* box = any<QSpinBox>()) box->setValue(box->minimum() + below(12));
        } else if (auto* field = any<QDoubleSpinBox>()) {
            const double reach = std::min(field->maximum() - field->minimum(), 3.0);
            field->setValue(field->minimum() + reach * below(101) / 100);
        }
    }

    void choose() {
        if (below(2) == 0) {
            if (auto* list = any<QComboBox>())
                if (list->count() > 0) list->setCurrentIndex(below(list->count()));
        } else if (auto* box = any<QCheckBox>()) {
            box->toggle();
        }
    }

    void trigger() {
        QList<QAction*> actions;
        for (QAction* action : window_.findChildren<QAction*>())
            if (action->isEnabled() && action->menu() == nullptr &&
                action->objectName() != "quit" && !action->text().contains("..."))
                actions << action;
        if (!actions.isEmpty()) actions.at(below(static_cast<int>(actions.size())))->trigger();
    }

    /// Large surfaces would only make the test slow.
    void keep_small() {
        window_.workbench().document().change("Small", [](StudioSettings& s) {
            Experiment& e = s.experiment;
            e.surface.size = std::min(e.surface.size, 128);
            e.detector.resolution = std::min(e.detector.resolution, 64);
            e.run.jitter = std::min(e.run.jitter, 2.0);
            e.run.bounces = std::min(e.run.bounces, 8);
            s.surface_view.path_count = std::min(s.surface_view.path_count, 50);
        });
        if (!window_.isVisible() || window_.isMinimized()) window_.showNormal();
    }

    StudioWindow& window_;
    std::mt19937 random_;
};

class MonkeyTest : public QObject {
    Q_OBJECT

  private slots:
    void ten_thousand_events() {
        const int events = number_from_environment("ASPERITY_MONKEY_EVENTS", 10000);
        const int seed = number_from_environment("ASPERITY_MONKEY_SEED", 4);
        TestScope scope;
        StudioWindow window({720, 560});
        window.set_small();
        Monkey monkey(window, static_cast<unsigned>(seed));
        QTimer closer;  // also runs inside dialogs that wait for an answer
        connect(&closer, &QTimer::timeout, &closer, close_what_is_open);
        closer.start(20);
        for (int event = 0; event < events; ++event) {
            monkey.act();
            close_what_is_open();
            QApplication::processEvents(QEventLoop::AllEvents, 2);
        }

        // It still works
        window.workbench().stop_drawing();
        window.view(SceneKind::Surface);
        window.workbench().document().reset({});
        window.set_small();
        QVERIFY(window.surface_comes());
        window.workbench().draw_to_textures();
        QVERIFY(QTest::qWaitFor([&] { return !window.workbench().is_drawing(); }, 60000));
        QVERIFY(window.workbench().drawing().result() != nullptr);
    }
};

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::MonkeyTest)
#include "monkey_test.moc"
