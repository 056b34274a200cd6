// SPDX-License-Identifier: Apache-2.0
// The dialog Export: all writers, files that are read back, what is said of them.
#include "dialogs_testing.h"

#include <QElapsedTimer>
#include <QFileInfo>

namespace asperity::studio::testing {

class ExportTest : public QObject {
    Q_OBJECT

  private slots:
    void init() { window_ = std::make_unique<DialogsWindow>(); }
    void cleanup() { window_.reset(); }

    void is_in_the_menu();
    void writers_are_those_of_the_registry();
    void layers_are_written_and_read_back();
    void a_model_keeps_its_values();
    void scenes_lie_beside_the_file();
    void a_wrong_option_is_said_at_its_field();
    void export_can_be_stopped();
    void a_stop_ends_it();
    void a_file_too_far_is_said();
    void screenshots();

  private:
    DialogsWindow& window() { return *window_; }

    TestScope scope_;
    std::unique_ptr<DialogsWindow> window_;
};

void ExportTest::is_in_the_menu() {
    ExportDialog& dialog = window().exporting();
    QVERIFY(dialog.isVisible());
    // Nothing is drawn yet
    auto& button = window().control<QPushButton>("export-write");
    QVERIFY(!button.isEnabled() && button.toolTip().contains("Draw To Textures"));
    QVERIFY(window().draw());
    QVERIFY(button.isEnabled());
    window().click("close-export");
    QVERIFY(!dialog.isVisible());
}

void ExportTest::writers_are_those_of_the_registry() {
    window().exporting();
    auto& list = window().control<QComboBox>("export-format");
    const io::BsdfFormats formats;
    int writers = 0;
    for (const io::BsdfFormat& format : formats.rows()) {
        if (!format.write) continue;
        const int place =
            list.findText(QString::fromStdString(format.name) + "  (", Qt::MatchStartsWith);
        QVERIFY2(place >= 0, format.name.c_str());
        list.setCurrentIndex(place);
        for (const io::FormatOption& option : format.options) {
            const QString name = "export-option-" + QString::fromStdString(option.name);
            QVERIFY2(window().findChild<QLineEdit*>(name) != nullptr, qPrintable(name));
        }
        ++writers;
    }
    QCOMPARE(list.count(), writers);
}

void ExportTest::layers_are_written_and_read_back() {
    window().workbench().document().change("Test", [](StudioSettings& s) {
        s.experiment.illumination.layers = 4;
        s.experiment.illumination.isotropic = true;
        s.experiment.detector.resolution = 32;
    });
    QVERIFY(window().surface_comes());
    QVERIFY(window().draw());
    ExportDialog& dialog = window().exporting();
    for (const auto& [format, ending] :
         {std::pair{"rgl", "bsdf"}, std::pair{"klems", "xml"}, std::pair{"csv", "csv"}}) {
        window()
            .control<QComboBox>("export-format")
            .setCurrentIndex(window()
                                 .control<QComboBox>("export-format")
                                 .findText(QString("%1  (").arg(format), Qt::MatchStartsWith));
        const QString path = scope_.path(QString("layers.%1").arg(ending));
        window().write(dialog, path);
        QVERIFY2(QFileInfo(path).size() > 1000, qPrintable(path));
        QVERIFY2(dialog.report().contains(path), qPrintable(dialog.report()));
        QVERIFY2(dialog.report().contains("L1 of f cos"), qPrintable(dialog.report()));
        QVERIFY(io::BsdfFormats().find(format)->read(path.toStdString()) != nullptr);
        QVERIFY(window().control<QLabel>("export-message").text().contains("is written"));
    }
    QVERIFY(window().workbench().log_lines().join('\n').contains("layers.bsdf"));
}

void ExportTest::a_model_keeps_its_values() {
    const auto file = io::BsdfFormats().read(window().ggx_file(scope_).toStdString());
    const double most = apart(*parse_brdf_spec("ggx:alpha=0.3,material=Au"), *file);
    QVERIFY2(most < 0.03, qPrintable(QString::number(most)));
}

void ExportTest::scenes_lie_beside_the_file() {
    ExportDialog& dialog = window().exporting();
    window().control<QComboBox>("export-source").setCurrentText("A model");
    auto& format = window().control<QComboBox>("export-format");
    auto& scenes = window().control<QCheckBox>("export-snippets");
    format.setCurrentIndex(format.findText("merl  (", Qt::MatchStartsWith));
    QVERIFY(!scenes.isEnabled());
    format.setCurrentIndex(format.findText("rgl  (", Qt::MatchStartsWith));
    QVERIFY(scenes.isEnabled());
    scenes.setChecked(true);
    window().write(dialog, scope_.path("ball.bsdf"));
    QVERIFY(QFileInfo::exists(scope_.path("ball_mitsuba.xml")));
    QVERIFY(dialog.report().contains("ball_mitsuba.xml"));
}

void ExportTest::a_wrong_option_is_said_at_its_field() {
    ExportDialog& dialog = window().exporting();
    window().control<QComboBox>("export-source").setCurrentText("A model");
    auto& format = window().control<QComboBox>("export-format");
    format.setCurrentIndex(format.findText("rgl  (", Qt::MatchStartsWith));
    auto& line = window().control<QLineEdit>("export-option-colour");
    const QColor calm = line.palette().color(QPalette::Base);
    line.setText("plaid");
    const QString path = scope_.path("plaid.bsdf");
    window().write(dialog, path);
    QVERIFY(!QFileInfo::exists(path));
    QVERIFY2(window().control<QLabel>("export-message").text().contains("plaid"),
             qPrintable(window().control<QLabel>("export-message").text()));
    QVERIFY(line.palette().color(QPalette::Base) != calm);
    line.setText("rgb");
    window().write(dialog, path);
    QVERIFY(QFileInfo::exists(path));
    QCOMPARE(line.palette().color(QPalette::Base), calm);
}

void ExportTest::export_can_be_stopped() {
    ExportDialog& dialog = window().exporting();
    window().control<QComboBox>("export-source").setCurrentText("A model");
    auto& format = window().control<QComboBox>("export-format");
    format.setCurrentIndex(format.findText("rgl  (", Qt::MatchStartsWith));
    QSignalSpy done(&dialog, &ExportDialog::exported);
    const QString path = scope_.path("stopped.bsdf");
    dialog.write(path);
    window().click("export-stop");
    QVERIFY(QTest::qWaitFor([&] { return done.count() > 0; }, 60000));
    const QString message = window().control<QLabel>("export-message").text();
    QVERIFY2(message.startsWith("stopped"), qPrintable(message));
    // Whole or not there, and it says which
    QCOMPARE(QFileInfo::exists(path), message.contains("is whole"));
    if (QFileInfo::exists(path)) QVERIFY(io::BsdfFormats().read(path.toStdString()) != nullptr);
}

void ExportTest::a_stop_ends_it() {
    // 128 slices of 160000 nodes take seconds
    ExportDialog& dialog = window().exporting();
    window().control<QComboBox>("export-source").setCurrentText("A model");
    auto& format = window().control<QComboBox>("export-format");
    format.setCurrentIndex(format.findText("rgl  (", Qt::MatchStartsWith));
    window().control<QLineEdit>("export-option-n").setText("400");
    window().control<QLineEdit>("export-option-theta").setText("128");
    QSignalSpy done(&dialog, &ExportDialog::exported);
    const QString path = scope_.path("large.bsdf");
    dialog.write(path);
    QTest::qWait(300);
    QVERIFY2(done.count() == 0, "the export was too quick to be stopped");
    QElapsedTimer timer;
    timer.start();
    window().click("export-stop");
    QVERIFY(QTest::qWaitFor([&] { return done.count() > 0; }, 60000));
    // cli_stop judges the time; here other windows paint beside it
    qInfo("stopped after %lld ms", static_cast<long long>(timer.elapsed()));
    QCOMPARE(window().control<QLabel>("export-message").text(),
             QString("stopped before anything was written"));
    QVERIFY(!QFileInfo::exists(path));
}

void ExportTest::a_file_too_far_is_said() {
    ExportDialog& dialog = window().exporting();
    window().control<QComboBox>("export-source").setCurrentText("A model");
    auto& format = window().control<QComboBox>("export-format");
    format.setCurrentIndex(format.findText("csv  (", Qt::MatchStartsWith));
    auto& most = window().control<QLineEdit>("export-max-error");
    const QColor calm = most.palette().color(QPalette::Base);
    const auto message = [&] { return window().control<QLabel>("export-message").text(); };
    most.setText("abc");
    dialog.write(scope_.path("k.csv"));
    QVERIFY(!QFileInfo::exists(scope_.path("k.csv")));
    QVERIFY2(message().contains("abc"), qPrintable(message()));
    QVERIFY(most.palette().color(QPalette::Base) != calm);
    most.setText("0.01%");
    window().write(dialog, scope_.path("k.csv"));
    QVERIFY2(message().contains("holds the data within"), qPrintable(message()));
    most.setText("90%");
    window().write(dialog, scope_.path("k.csv"));
    QVERIFY2(message().endsWith("is written"), qPrintable(message()));
    // What is not read back has no error
    format.setCurrentIndex(format.findText("layers-csv  (", Qt::MatchStartsWith));
    QVERIFY(!most.isEnabled() && most.text().isEmpty());
}

void ExportTest::screenshots() {
    window().draw_gold();
    ExportDialog& dialog = window().exporting();
    auto& format = window().control<QComboBox>("export-format");
    format.setCurrentIndex(format.findText("rgl  (", Qt::MatchStartsWith));
    window().control<QCheckBox>("export-snippets").setChecked(true);
    QDir::setCurrent(scope_.path({}));
    window().write(dialog, "gold.bsdf");
    dialog.resize(900, 480);
    shoot(dialog, "export");
    QVERIFY(dialog.minimumSizeHint().width() <= 900 && dialog.minimumSizeHint().height() <= 560);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::ExportTest)
#include "export_test.moc"
