// SPDX-License-Identifier: Apache-2.0
// The first minute of a new user, step by step, at two sizes of the window: what he sees is looked
// at by number, and kept as pictures in the folder ASPERITY_SCREENSHOTS, else screenshots/ where
// the test runs.
#include "studio_window.h"

#include "view/model_scene.h"
#include "view/plots_panel.h"
#include "view/surface_scene.h"
#include "view/theme.h"

#include <QDir>
#include <QSignalSpy>

#include <memory>

namespace asperity::studio::testing {

class FirstMinuteTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase();
    void cleanup() { window_.reset(); }
    void first_minute_data();
    void first_minute();

  private:
    void shoot(const QString& name);
    void edit(const std::function<void(StudioSettings&)>& change);
    StudioWindow& window() { return *window_; }

    TestScope scope_;
    QDir folder_;
    std::unique_ptr<StudioWindow> window_;
};

void FirstMinuteTest::initTestCase() {
    folder_.setPath(qEnvironmentVariable("ASPERITY_SCREENSHOTS", "screenshots"));
    QVERIFY(folder_.mkpath("."));
    apply_theme(Theme::Dark);
}

void FirstMinuteTest::edit(const std::function<void(StudioSettings&)>& change) {
    window().workbench().document().change("First minute", change);
}

void FirstMinuteTest::shoot(const QString& name) {
    QTest::qWait(400);  // plots and statistics follow by timers
    static_cast<void>(
        QTest::qWaitFor([this] { return window().viewport().frame().passes >= 16; }, 3000));
    const QString path = QString("first-minute-%1-%2.png").arg(QTest::currentDataTag(), name);
    QVERIFY(window().grab().toImage().save(folder_.filePath(path)));
}

void FirstMinuteTest::first_minute_data() {
    QTest::addColumn<QSize>("size");
    QTest::newRow("1280x800") << QSize(1280, 800);
    QTest::newRow("1920x1080") << QSize(1920, 1080);
}

void FirstMinuteTest::first_minute() {
    QFETCH(QSize, size);
    window_ = std::make_unique<StudioWindow>(size);
    QSignalSpy complaints(&window().workbench(), &Workbench::complaint);
    window().begin(true);
    QCOMPARE(window().size(), size);
    // Nobody has pressed a button, and it measures
    QVERIFY(window().workbench().is_drawing());
    QVERIFY(window().surface_comes());
    QTest::qWait(300);
    shoot("1-start");
    QVERIFY(QTest::qWaitFor([this] { return !window().workbench().is_drawing(); }, 120000));
    QVERIFY(window().workbench().are_layers_current());
    QVERIFY(window().picture_comes());
    shoot("2-drawn");
    const QImage drawn = window().picture();
    const auto golden = [](const QColor& c) {
        return c.red() > c.green() && c.green() > c.blue() + 40 && c.red() > 120;
    };
    const auto of_dome = [](const QColor& c) { return c.blue() > c.red() && c.blue() > 60; };
    const double gold = share_of(drawn, golden), dome = share_of(drawn, of_dome);
    QVERIFY2(gold > 0.01, qPrintable(QString::number(gold)));
    QVERIFY2(dome > 0.08, qPrintable(QString::number(dome)));
    QVERIFY(share_of(drawn, is_green) < 0.001);  // no noise of normals
    window().load_model("ball");
    QVERIFY(QTest::qWaitFor([this] { return window().model_scene().has_model(); }, 60000));
    QVERIFY(window().picture_comes());
    shoot("3-model");
    // Light all over, and nothing of it cut off
    const QImage model = window().picture();
    const auto clipped = [](const QColor& c) {
        return c.red() == 255 && c.green() == 255 && c.blue() == 255;
    };
    QVERIFY(share_of(model, clipped) < 0.01);
    QVERIFY(share_of(model, is_black) < 0.01);
    QVERIFY(share_of(model, golden) > 0.05);
    edit([](StudioSettings& s) { s.model_view.compare = true; });
    QTest::qWait(1500);
    QVERIFY(window().picture_comes());
    shoot("4-compare");
    QVERIFY(window().model_scene().stage().left_name().startsWith("Simulated"));
    QVERIFY(window().model_scene().stage().right_name().startsWith("Cook-Torrance"));
    window().view(SceneKind::Surface);
    window().set_presenting(true);
    QVERIFY(window().picture_comes());
    shoot("5-presentation");
    window().set_presenting(false);
    QCOMPARE(complaints.count(), 0);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::FirstMinuteTest)
#include "first_minute_test.moc"
