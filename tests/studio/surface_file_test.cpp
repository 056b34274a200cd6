// SPDX-License-Identifier: Apache-2.0
// A surface from an instrument, in the studio: channel, units, what is done to it, before and
// after, the report. The files are made here, so what must come out is known.
#include "studio_window.h"
#include "surface_test_files.h"

#include "model/session_text.h"
#include "model/words.h"
#include "view/before_after.h"
#include "view/surface_file_dialog.h"
#include "view/theme.h"

#include <asperity/surface/statistics.h>

#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>

#include <cmath>
#include <memory>

namespace asperity::studio::testing {

class SurfaceFileTest : public QObject {
    Q_OBJECT

  private slots:
    void init();
    void cleanup() { window_.reset(); }

    void a_tilted_surface_with_holes_is_made_ready();
    void steps_act_and_can_be_undone();
    void channels_are_chosen_from_what_the_file_holds();
    void what_cannot_be_done_is_said_at_its_field();
    void too_many_holes_show_what_was_measured();
    void an_ambiguous_text_is_decided();
    void sessions_keep_all();
    void work_can_be_stopped();
    void words_are_those_of_the_forms();
    void screenshots();

  private:
    StudioWindow& window() { return *window_; }
    QString write(const QString& name, const QByteArray& bytes);
    /// Opens a file, waits for its surface or the complaint, and shows the dialog.
    SurfaceFileDialog& open(const QString& path);
    void set(const char* line, const QString& text);
    /// Of the surface as it stands, before it is mirrored [um].
    double sq();
    const FileReading& reading() { return *window().workbench().surface().reading(); }
    QString message() { return window().control<QLabel>("surface-file-message").text(); }
    void shoot(QWidget& widget, const QString& name);

    TestScope scope_;
    std::unique_ptr<StudioWindow> window_;
};

void SurfaceFileTest::init() {
    apply_theme(Theme::Dark);
    window_ = std::make_unique<StudioWindow>();
    window().set_small();
    QVERIFY(window().surface_comes());
}

QString SurfaceFileTest::write(const QString& name, const QByteArray& bytes) {
    QFile file(scope_.path(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) qFatal("no file");
    return file.fileName();
}

SurfaceFileDialog& SurfaceFileTest::open(const QString& path) {
    window().open(path);
    if (!window().surface_comes()) qFatal("no surface");
    window().click("make-ready");
    return *window().findChild<SurfaceFileDialog*>();
}

void SurfaceFileTest::set(const char* name, const QString& text) {
    if (auto* box = window().findChild<QDoubleSpinBox*>(name)) {
        box->setValue(text.toDouble());
        QVERIFY(window().surface_comes());
        return;
    }
    auto& line = window().control<QLineEdit>(name);
    line.setText(text);
    emit line.editingFinished();
    QVERIFY(window().surface_comes());
}

double SurfaceFileTest::sq() {
    return 1e6 * statistics(*reading().patch, 1).rms_height;
}

void SurfaceFileTest::a_tilted_surface_with_holes_is_made_ready() {
    SurfaceFileDialog& dialog = open(write("tilted.txt", text_file(4)));
    QVERIFY2(window().workbench().surface().trouble().isEmpty(),
             qPrintable(window().workbench().surface().trouble()));
    QCOMPARE(reading().missing, std::size_t{16});
    QCOMPARE(reading().before.unit, std::string("m"));
    QVERIFY(std::abs(1e6 * reading().before.size_x - 32) < 1e-9);
    // The plane is gone and the holes are closed; 16 points of 4096 hardly change the mean square
    QVERIFY2(std::abs(sq() - kAmplitude / std::sqrt(2.0)) < 0.002,
             qPrintable(QString::number(sq())));
    const auto& patch = *reading().patch;
    for (const float h : patch.heights)
        QVERIFY(std::abs(static_cast<double>(h)) < 1.02e-6 * kAmplitude);
    // The report says what was read and done, and the figures follow
    QVERIFY(QTest::qWaitFor([&] { return dialog.report().contains("Sa, Sq"); }, 20000));
    const QString report = dialog.report();
    for (const char* part : {"16 of 4096 points missing", "filled smoothly", "mean plane taken off",
                             "opposite edges fit", "geometric optics"})
        QVERIFY2(report.contains(part, Qt::CaseInsensitive), qPrintable(report));
    QVERIFY(report.contains("0.141"));  // Sq, in um
    // And all of it is what light will fall on
    QCOMPARE(window().workbench().surface().surface()->nx, kSide);
    window().choose("file-tiling", "Mirror");
    QVERIFY(window().surface_comes());
    QCOMPARE(window().workbench().surface().surface()->nx, 2 * kSide - 2);
    QVERIFY(window().draw());
}

void SurfaceFileTest::steps_act_and_can_be_undone() {
    open(write("tilted.txt", text_file(0)));
    const double level = sq();
    window().choose("file-level", "None");
    QVERIFY(window().surface_comes());
    // With the tilt: the plane's own variance, (slope * width)^2 / 12 each way, is there too
    const double width = kStep * std::sqrt(kSide * kSide - 1.0);
    const double tilted = std::sqrt(level * level + 1.25 * std::pow(kTilt * width, 2) / 12);
    QVERIFY2(std::abs(sq() - tilted) < 1e-4, qPrintable(QString("%1 %2").arg(sq()).arg(tilted)));
    window().workbench().document().undo_stack().undo();
    QVERIFY(window().surface_comes());
    QVERIFY(std::abs(sq() - level) < 1e-9);
    QCOMPARE(window().control<QComboBox>("file-level").currentText(), QString("Auto"));
    set("file-crop", "0,0,16,8um");
    QCOMPARE(reading().patch->nx, 32);
    QCOMPARE(reading().patch->ny, 16);
    set("file-crop", "");
    set("file-resample", "32");
    QCOMPARE(reading().patch->nx, 32);
    QCOMPARE(reading().patch->ny, 32);
    set("file-resample", "");
    // A Gaussian of cut-off c leaves exp(-pi (a c / w)^2) of waves of length w, a^2 = ln 2 / pi:
    // half of those of the cut-off
    set("file-filter-s", "16um");
    QVERIFY2(std::abs(sq() / level - 0.5) < 0.05, qPrintable(QString::number(sq() / level)));
    set("file-filter-s", "");
    set("file-height-scale", "2");
    QVERIFY(std::abs(sq() / level - 2) < 1e-6);
    set("file-cell-size", "1 um");
    QCOMPARE(reading().patch->dx, 1e-6);
    QCOMPARE(window().control<QLineEdit>("file-cell-size").text(), QString("1 um"));
    window().choose("file-tiling", "Finite");
    QVERIFY(window().surface_comes());
    QCOMPARE(window().workbench().surface().surface()->boundary, Boundary::Finite);
}

void SurfaceFileTest::channels_are_chosen_from_what_the_file_holds() {
    open(write("channels.gwy", gwy_file()));
    auto& list = window().control<QComboBox>("surface-channel");
    QVERIFY(QTest::qWaitFor([&] { return list.count() == 4; }, 10000));
    QVERIFY(list.itemText(0).contains("2"));
    QVERIFY(list.itemText(1).startsWith("Height"));
    QVERIFY(list.itemText(3).contains("Sensor") && list.itemText(3).contains("no heights"));
    // Nothing is guessed
    QVERIFY(message().contains("Channel"));
    QVERIFY(!window().control<QLabel>("surface-file-note").text().isEmpty());
    list.setCurrentIndex(1);
    QVERIFY(window().surface_comes());
    const double first = sq();
    QVERIFY(std::abs(first - kAmplitude / std::sqrt(2.0)) < 1e-6);
    list.setCurrentIndex(2);
    QVERIFY(window().surface_comes());
    QVERIFY(std::abs(sq() / first - 2) < 1e-6);
    QCOMPARE(message(), QString());
    // Another file has channels of its own
    window().open(write("tilted.txt", text_file(0)));
    QVERIFY(window().surface_comes());
    QVERIFY(window().workbench().surface().trouble().isEmpty());
    QVERIFY(QTest::qWaitFor([&] { return list.count() == 2; }, 10000));
}

void SurfaceFileTest::what_cannot_be_done_is_said_at_its_field() {
    SurfaceFileDialog& dialog = open(write("tilted.txt", text_file(0)));
    const QPoint place =
        window().control<QPushButton>("close-surface-file").mapTo(&dialog, QPoint());
    auto& line = window().control<QLineEdit>("file-filter-s");
    const QColor calm = line.palette().color(QPalette::Base);
    // No length at all: the words stay to be mended, the surface stays
    set("file-filter-s", "short");
    QCOMPARE(line.text(), QString("short"));
    QVERIFY(line.palette().color(QPalette::Base) != calm);
    QVERIFY2(message().contains("no length"), qPrintable(message()));
    // A length that this surface has no room for
    set("file-filter-s", "90um");
    QVERIFY2(message().startsWith("Filter S: ") && message().contains("longer than the surface"),
             qPrintable(message()));
    QVERIFY(line.palette().color(QPalette::Base) != calm);
    QVERIFY(reading().patch == nullptr && reading().before.width > 0);
    set("file-filter-s", "4um");
    QCOMPARE(message(), QString());
    QCOMPARE(line.palette().color(QPalette::Base), calm);
    QCOMPARE(window().control<QPushButton>("close-surface-file").mapTo(&dialog, QPoint()), place);
}

void SurfaceFileTest::too_many_holes_show_what_was_measured() {
    SurfaceFileDialog& dialog = open(write("holes.txt", text_file(20)));
    QVERIFY2(message().contains("400 of 4096 points are missing"), qPrintable(message()));
    QVERIFY2(message().contains("Fill smooth") && !message().contains("--"), qPrintable(message()));
    QVERIFY(dialog.report().contains("400 of 4096 points missing"));
    window().choose("file-fill", "Nearest");
    QVERIFY(window().surface_comes());
    QCOMPARE(message(), QString());
    QVERIFY(reading().patch != nullptr);
    QVERIFY(QString::fromStdString(reading().prepared).contains("nearest"));
}

void SurfaceFileTest::an_ambiguous_text_is_decided() {
    open(write("comma.txt", "1,5 2.5\n3,4 0.5\n"));
    QVERIFY2(message().contains("Decimal"), qPrintable(message()));
    window().choose("file-decimal", "point");
    QVERIFY(window().surface_comes());
    QCOMPARE(message(), QString());
    QCOMPARE(reading().patch->nx, 3);
    QCOMPARE(reading().before.high, 5.0);
}

void SurfaceFileTest::sessions_keep_all() {
    open(write("channels.gwy", gwy_file()));
    window().workbench().document().change("Test", [](StudioSettings& s) {
        SurfaceSettings& surface = s.experiment.surface;
        surface.file_channel = "Second";
        surface.ready.level = Level::Order2;
        surface.ready.outliers = 5;
        surface.ready.filter_l = Length{12, "um"};
        surface.cell_x = surface.cell_y = 0.25e-6;
    });
    QVERIFY(window().surface_comes());
    const double before = sq();
    const QString path = scope_.path("file.conf");
    window().workbench().document().save(path);
    window().new_session();
    QVERIFY(window().surface_comes());
    QVERIFY(window().workbench().surface().reading() == nullptr);
    window().open(path);
    QVERIFY(window().surface_comes());
    QCOMPARE(sq(), before);
    QCOMPARE(window().control<QComboBox>("surface-channel").currentData().toString(),
             QString("Second"));
    QCOMPARE(window().control<QLineEdit>("file-filter-l").text(), QString("12 um"));
    QCOMPARE(window().control<QLineEdit>("file-cell-size").text(), QString("0.25 um"));
}

void SurfaceFileTest::work_can_be_stopped() {
    open(write("tilted.txt", text_file(0)));
    const auto before = window().workbench().surface().surface();
    window().click("read-again");
    QVERIFY(window().workbench().surface().busy());
    window().click("surface-file-stop");
    QVERIFY(!window().workbench().surface().busy());
    QVERIFY2(message().contains("stopped"), qPrintable(message()));
    QCOMPARE(window().workbench().surface().surface(), before);
    window().click("read-again");
    QVERIFY(window().surface_comes());
    QCOMPARE(message(), QString());
    QVERIFY(window().workbench().surface().surface() != before);
}

void SurfaceFileTest::words_are_those_of_the_forms() {
    QCOMPARE(in_words_of_forms("filter-s: a cut-off of 1 um is short"),
             QString("Filter S: a cut-off of 1 um is short"));
    QCOMPARE(in_words_of_forms("a.txt: 5 points are missing: --fill nearest or smooth fills them"),
             QString("a.txt: 5 points are missing: Fill nearest or smooth fills them"));
    QCOMPARE(in_words_of_forms("--cell-size, --nonsense"), QString("Cell Size, --nonsense"));
    QCOMPARE(setting_complained_of("a.txt: bad"), std::string());
    QCOMPARE(setting_complained_of("crop: bad"), std::string("crop"));
}

void SurfaceFileTest::shoot(QWidget& widget, const QString& name) {
    QDir folder(qEnvironmentVariable("ASPERITY_SCREENSHOTS", "screenshots"));
    QVERIFY(folder.mkpath("."));
    QTest::qWait(300);
    QVERIFY(widget.grab().toImage().save(folder.filePath(name + ".png")));
}

void SurfaceFileTest::screenshots() {
    write("ground.txt", ground_file());
    QDir::setCurrent(scope_.path({}));
    SurfaceFileDialog& dialog = open("ground.txt");
    set("file-outliers", "8");
    QVERIFY(QTest::qWaitFor([&] { return dialog.report().contains("Sa, Sq"); }, 20000));
    shoot(dialog, "surface-file");
    shoot(window(), "surface-file-window");
    window().resize(1024, 640);
    dialog.resize(900, 560);
    shoot(dialog, "surface-file-small");
    set("file-filter-s", "900um");
    shoot(dialog, "surface-file-trouble");
    shoot(window(), "surface-file-trouble-window");
    // It fits the small screen, the picture is large enough to be seen
    QVERIFY(dialog.minimumSizeHint().width() <= 900 && dialog.minimumSizeHint().height() <= 560);
    QVERIFY(dialog.findChild<BeforeAfter*>()->height() > 180);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::SurfaceFileTest)
#include "surface_file_test.moc"
