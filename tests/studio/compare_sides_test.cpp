// SPDX-License-Identifier: Apache-2.0
// Each side of a comparison has its own result, model or measured file.
#include "model_testing.h"

#include "model/export_job.h"
#include "model/session_text.h"

#include <QDropEvent>
#include <QLineEdit>
#include <QMimeData>

namespace asperity::studio {

class CompareSidesTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase();

    void each_side_has_its_own();
    void one_side_does_not_wait_for_the_other();
    void what_one_side_lacks_is_said();
    void a_dropped_file_goes_where_one_is_worn();
    void older_sessions_had_one_result();

  private:
    QString path(const char* name) const { return folder_.filePath(name); }
    /// Simulated on the left, the measured file on the right, both there.
    void compare(Bench& bench);

    QTemporaryDir folder_;
    std::string result_, other_, file_;
};

void CompareSidesTest::initTestCase() {
    result_ = path("drawn.asperity").toStdString();
    other_ = path("other.asperity").toStdString();
    file_ = path("gold.bsdf").toStdString();
    Measurement measurement = small_measurement();
    io::save_measurement(measurement, result_);
    measurement.surface_name = "another surface";
    io::save_measurement(measurement, other_);
    ExportWish wish;
    wish.source = {BrdfSource::Kind::Model, "ggx:alpha=0.2,material=Au"};
    wish.format = "rgl";
    wish.path = file_;
    Run run;
    QCOMPARE(export_brdf(wish, run).written.size(), 1);
}

void CompareSidesTest::compare(Bench& bench) {
    bench.begin();
    bench.change([this](ModelView& view) {
        view.compare = true;
        view.brdf.type = view.second.type = BrdfType::Simulated;
        view.brdf.result = result_;
    });
    auto* file = bench.find<QLineEdit>("second-result-file");
    QVERIFY(file->isVisible());
    file->setText(QString::fromStdString(file_));
    emit file->editingFinished();
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().message().isEmpty(), 30000);
}

void CompareSidesTest::each_side_has_its_own() {
    Bench bench;
    compare(bench);
    QCOMPARE(bench.workbench.settings().model_view.second.result, file_);
    QCOMPARE(bench.workbench.settings().model_view.brdf.result, result_);
    QVERIFY(bench.scene.stage().left_name().startsWith("Simulated, "));
    QCOMPARE(bench.scene.stage().right_name(), QString("gold.bsdf"));
    const Film both = paint(bench.scene);
    bench.change([](ModelView& view) { view.compare = false; });
    const Film left = paint(bench.scene);
    bench.change([this](ModelView& view) { view.brdf.result = file_; });
    QVERIFY2(bench.scene.stage().message().isEmpty(), "it is there already");
    const Film right = paint(bench.scene);
    QVERIFY(!same(left, right));
    const int y = kSmall.height() / 2;
    for (int x = 20; x < kSmall.width() - 20; ++x) {
        if (std::abs(x - kSmall.width() / 2) < 3) continue;
        const Film& alone = x < kSmall.width() / 2 ? left : right;
        QVERIFY2(both.at(x, y).mean.r == alone.at(x, y).mean.r, qPrintable(QString::number(x)));
        QVERIFY(both.at(x, y).mean.b == alone.at(x, y).mean.b);
    }
}

void CompareSidesTest::one_side_does_not_wait_for_the_other() {
    Bench bench;
    compare(bench);
    const Bsdf* left = &bench.scene.stage().sight()->scene.material.brdf();
    bench.change([this](ModelView& view) { view.second.result = other_; });
    QCOMPARE(&bench.scene.stage().sight()->scene.material.brdf(), left);
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().right_name().contains("another surface"), 30000);
    QCOMPARE(&bench.scene.stage().sight()->scene.material.brdf(), left);
    // A model on one side leaves the other, too
    bench.change([](ModelView& view) { view.second.type = BrdfType::Model; });
    QVERIFY(bench.scene.stage().message().isEmpty());
    QCOMPARE(&bench.scene.stage().sight()->scene.material.brdf(), left);
    QVERIFY(bench.scene.stage().right_name().startsWith("Cook-Torrance"));
}

void CompareSidesTest::what_one_side_lacks_is_said() {
    Bench bench;
    compare(bench);
    bench.complaints.clear();
    bench.change([](ModelView& view) { view.second.result = "nowhere.asperity"; });
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().message().startsWith("nowhere.asperity"), 60000);
    QVERIFY(bench.scene.stage().left_name().startsWith("Simulated, "));
    QCOMPARE(bench.complaints.size(), 1);
    // The other side may change; it is not said again
    bench.change([](ModelView& view) { view.brdf.normalize_factor = 2; });
    QTest::qWait(50);
    QCOMPARE(bench.complaints.size(), 1);
    bench.change([](ModelView& view) { view.second.result = {}; });
    QVERIFY2(bench.scene.stage().message().contains("draw textures"),
             qPrintable(bench.scene.stage().message()));
}

void CompareSidesTest::a_dropped_file_goes_where_one_is_worn() {
    Bench bench;
    bench.begin();
    const auto drop = [&bench](const std::string& file) {
        QMimeData files;
        files.setUrls({QUrl::fromLocalFile(QString::fromStdString(file))});
        QDragEnterEvent enters(QPoint(9, 9), Qt::CopyAction, &files, Qt::LeftButton, {});
        QCoreApplication::sendEvent(&bench.scene, &enters);
        QDropEvent event(QPointF(9, 9), Qt::CopyAction, &files, Qt::LeftButton, {});
        QCoreApplication::sendEvent(&bench.scene, &event);
    };
    const auto& view = bench.workbench.settings().model_view;
    bench.change([](ModelView& v) {
        v.compare = true;
        v.brdf.type = BrdfType::Model;
        v.second.type = BrdfType::Simulated;
    });
    drop(file_);
    QCOMPARE(view.second.result, file_);
    QVERIFY(view.brdf.result.empty() && view.brdf.type == BrdfType::Model);
    bench.change([](ModelView& v) { v.compare = false; });
    drop(result_);
    QCOMPARE(view.brdf.result, result_);
    QVERIFY(view.brdf.type == BrdfType::Simulated);
    QCOMPARE(view.second.result, file_);
}

void CompareSidesTest::older_sessions_had_one_result() {
    const StudioSettings older =
        session_from_text("[studio]\nresult = old.asperity\ncompare = true\n", "old.conf");
    QCOMPARE(older.model_view.brdf.result, std::string("old.asperity"));
    QCOMPARE(older.model_view.second.result, std::string("old.asperity"));
    StudioSettings settings;
    settings.model_view.brdf.result = "a.asperity";
    const StudioSettings again = session_from_text(session_text(settings), "new.conf");
    QCOMPARE(again.model_view.brdf.result, std::string("a.asperity"));
    QVERIFY(again.model_view.second.result.empty());
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::CompareSidesTest)
#include "compare_sides_test.moc"
