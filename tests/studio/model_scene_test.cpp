// SPDX-License-Identifier: Apache-2.0
// The scene "Model" as a user handles it: fields, files, split line, undo, saved pictures.
#include "model_testing.h"

#include <asperity/core/error.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/models/model_reader.h>

#include <QDropEvent>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QMimeData>

namespace asperity::studio {

namespace {

void drop(QWidget& target, const QString& path) {
    QMimeData files;
    files.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter({5, 5}, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&target, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent event({5, 5}, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&target, &event);
}

void write(const QString& path, const QByteArray& content) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
}

/// A grey world all round.
void write_environment(const std::string& path) {
    Film film(8, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) film.at(x, y).add({0.5, 0.5, 0.5});
    io::write_render_exr(film, {}, path);
}

const ModelView& view_of(Bench& bench) {
    return bench.workbench.settings().model_view;
}

}  // namespace

class ModelSceneTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase() { QVERIFY(folder_.isValid()); }
    void brdf_type_switches_the_fields();
    void every_control_has_a_tooltip();
    void a_model_is_loaded_and_seen();
    void a_bad_file_leaves_the_model();
    void nothing_drawn_is_said();
    void layers_drawn_are_worn();
    void files_can_be_dropped();
    void undo_brings_the_picture_back();
    void the_split_line_moves_by_mouse_and_keys();
    void pictures_are_saved_as_shown();
    void camera_type_is_a_setting();
    void it_closes_while_a_brdf_is_made();

  private:
    QString path(const char* name) const { return folder_.filePath(name); }
    QTemporaryDir folder_;
};

void ModelSceneTest::brdf_type_switches_the_fields() {
    Bench bench;
    auto* metallic = bench.find<QDoubleSpinBox>("metallic");
    auto* factor = bench.find<QDoubleSpinBox>("normalize-factor");
    auto* result = bench.find<QLineEdit>("result-file");
    QVERIFY(metallic->isVisible() && !factor->isVisible() && !result->isVisible());
    bench.find<QComboBox>("brdf-type")->setCurrentText("Simulated");
    QVERIFY(!metallic->isVisible() && factor->isVisible() && result->isVisible());
    QVERIFY(view_of(bench).brdf.type == BrdfType::Simulated);
    bench.workbench.document().undo_stack().undo();
    QVERIFY(metallic->isVisible() && !factor->isVisible());

    auto* second = bench.find<QDoubleSpinBox>("second-normalize-factor");
    QVERIFY(!second->isVisible());
    bench.find<QCheckBox>("compare")->setChecked(true);
    // Each side has a result of its own
    QVERIFY(second->isVisible() && !result->isVisible());
    QVERIFY(bench.find<QLineEdit>("second-result-file")->isVisible());
    bench.set("second-normalize-factor", 3);
    QCOMPARE(view_of(bench).second.normalize_factor, 3.0);
    QCOMPARE(view_of(bench).brdf.normalize_factor, 1.0);
}

void ModelSceneTest::every_control_has_a_tooltip() {
    Bench bench;
    for (const char* name :
         {"brdf-type",   "metallic",         "roughness",     "albedo-r",    "normalize-factor",
          "diffuse-g",   "second-roughness", "compare",       "split",       "light-kind",
          "light-x",     "light-intensity",  "sun-elevation", "sun-azimuth", "environment-rotation",
          "exposure",    "tone-mapping",     "depth",         "floor",       "model-name",
          "result-file", "environment-file"})
        QVERIFY2(bench.find<QWidget>(name)->toolTip().size() > 10, name);
}

void ModelSceneTest::a_model_is_loaded_and_seen() {
    Bench bench;
    QVERIFY(!bench.scene.has_model());
    QCOMPARE(bench.scene.statistics(), ModelStatistics{});
    QSignalSpy ready(&bench.scene, &ModelScene::model_ready);
    bench.scene.load("sphere");
    QTRY_COMPARE_WITH_TIMEOUT(ready.count(), 1, 60000);
    QVERIFY(bench.scene.has_model());
    QCOMPARE(bench.scene.statistics().unique_triangles, 2ull * 512 * 255);
    QVERIFY(bench.workbench.settings().scene == SceneKind::Model);
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.is_settled(), 60000);
    const QImage shown = bench.scene.viewport().grab_picture();
    QTRY_COMPARE_WITH_TIMEOUT(bench.scene.viewport().grab_picture().pixelColor(160, 120),
                              QColor(Qt::black), 60000);

    bench.change([](ModelView& view) { view.brdf_runs = true; });
    QTRY_VERIFY_WITH_TIMEOUT(
        bench.scene.viewport().grab_picture().pixelColor(160, 120).lightness() > 60, 60000);
    auto* models = bench.find<QComboBox>("model-name");
    QCOMPARE(models->currentText(), QString("sphere"));
    models->setCurrentText("knot");
    emit models->activated(models->currentIndex());
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().model().name() == "knot", 60000);
}

void ModelSceneTest::a_bad_file_leaves_the_model() {
    Bench bench;
    bench.begin();
    const auto before = bench.scene.stage().model().traced();
    write(path("bad.obj"), "v 0 0 0\nv 1 0 0\nf 1 2 99\n");
    std::string cli;
    try {
        io::read_model(path("bad.obj").toStdString());
    } catch (const Error& error) {
        cli = error.what();
    }
    QVERIFY(!cli.empty());
    bench.scene.load(path("bad.obj"));
    QTRY_COMPARE_WITH_TIMEOUT(bench.complaints, QStringList{QString::fromStdString(cli)}, 60000);
    QCOMPARE(bench.scene.stage().model().traced(), before);
    QCOMPARE(view_of(bench).model, std::string("sphere"));
    QVERIFY(bench.scene.stage().message().isEmpty());

    bench.scene.load("no-such-model");
    QTRY_COMPARE_WITH_TIMEOUT(bench.complaints.size(), 2, 60000);
    QVERIFY(bench.complaints.last().contains("knot"));
}

void ModelSceneTest::nothing_drawn_is_said() {
    Bench bench;
    bench.begin();
    bench.find<QComboBox>("brdf-type")->setCurrentText("Simulated");
    const QString sentence =
        "draw textures in the scene Microfacets Surface first, or open a result";
    QCOMPARE(bench.complaints, QStringList{sentence});
    QCOMPARE(bench.scene.stage().message(), sentence);
    QVERIFY(is_black(paint(bench.scene).at(kSmall.width() / 2, kSmall.height() / 2).mean));

    // Asked again, it is said again
    bench.change([](ModelView& view) { view.brdf_runs = false; });
    QVERIFY(bench.scene.stage().message().isEmpty());
    bench.change([](ModelView& view) { view.brdf_runs = true; });
    QCOMPARE(bench.scene.stage().message(), sentence);
    QCOMPARE(bench.complaints.size(), 2);

    bench.change([&](ModelView& view) { view.brdf.result = "nowhere.asperity"; });
    QTRY_COMPARE_WITH_TIMEOUT(bench.complaints.size(), 3, 60000);
    QVERIFY(bench.complaints.last().startsWith("nowhere.asperity: "));
}

void ModelSceneTest::layers_drawn_are_worn() {
    Bench bench;
    bench.begin();
    bench.workbench.document().change("Test", [](StudioSettings& s) {
        s.experiment.surface.size = 120;
        s.experiment.detector.resolution = 32;
        s.experiment.run.bounces = 4;
        s.model_view.brdf.type = BrdfType::Simulated;
    });
    // What is said while it draws, which may be for a moment only
    QStringList said;
    const Drawing& drawing = bench.workbench.drawing();
    connect(&drawing, &Drawing::state_changed, this, [&] {
        if (drawing.state() == Drawing::State::Drawing) said << bench.scene.stage().message();
    });
    bench.workbench.draw_to_textures();
    QTRY_VERIFY_WITH_TIMEOUT(drawing.result() != nullptr, 60000);
    QCOMPARE(said.size(), 1);
    QVERIFY2(said.first().contains("still being drawn"), qPrintable(said.first()));
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().message().isEmpty(), 60000);
    const auto sight = bench.scene.stage().sight();
    QVERIFY(sight->scene.material.brdf().name().starts_with("tabulated:"));
    QVERIFY(luminance(paint(bench.scene).at(kSmall.width() / 2, kSmall.height() / 2).mean) > 0);

    bench.workbench.drawing().clear();
    QVERIFY(!bench.scene.stage().message().isEmpty());
}

void ModelSceneTest::files_can_be_dropped() {
    io::save_measurement(small_measurement(), path("small.asperity").toStdString());
    write_environment(path("grey.exr").toStdString());
    write(path("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write(path("notes.txt"), "nothing to be seen");
    Bench bench;
    drop(bench.scene, path("one.obj"));
    QTRY_COMPARE_WITH_TIMEOUT(bench.scene.statistics().unique_triangles, 1ull, 60000);
    bench.change([](ModelView& view) { view.brdf_runs = true; });

    drop(bench.scene, path("small.asperity"));
    QVERIFY(view_of(bench).brdf.type == BrdfType::Simulated);
    QTRY_VERIFY_WITH_TIMEOUT(bench.scene.stage().message().isEmpty(), 30000);

    drop(bench.scene, path("grey.exr"));
    QVERIFY(view_of(bench).light == LightKind::Environment);
    QTRY_VERIFY_WITH_TIMEOUT(!bench.scene.stage().sight()->backdrop, 60000);
    const Rgb behind = paint(bench.scene).at(1, 1).mean;
    QVERIFY(std::abs(behind.g - 0.5) < 1e-6);

    QVERIFY(bench.complaints.isEmpty());
    drop(bench.scene, path("notes.txt"));
    QCOMPARE(bench.complaints.size(), 1);
}

void ModelSceneTest::undo_brings_the_picture_back() {
    Bench bench;
    bench.begin();
    const Film before = paint(bench.scene);
    bench.set("roughness", 0.9);
    bench.set("metallic", 0.2);
    QVERIFY(!same(paint(bench.scene), before));
    QUndoStack& history = bench.workbench.document().undo_stack();
    QCOMPARE(history.undoText(), QString("Metallic"));
    history.undo();
    history.undo();
    QVERIFY(same(paint(bench.scene), before));
    QCOMPARE(bench.find<QDoubleSpinBox>("roughness")->value(), 0.4);
}

void ModelSceneTest::the_split_line_moves_by_mouse_and_keys() {
    Bench bench;
    bench.begin();
    auto* handle = bench.scene.findChild<QWidget*>("split-handle");
    QVERIFY(handle != nullptr && !handle->isVisible());
    bench.change([](ModelView& view) {
        view.compare = true;
        view.second.type = BrdfType::Model;
    });
    QVERIFY(handle->isVisible());
    const QPoint middle = handle->rect().center();
    QTest::mousePress(handle, Qt::LeftButton, {}, middle);
    QTest::mouseMove(handle, middle + QPoint(-40, 0));
    QTest::mouseMove(handle, middle + QPoint(-40, 0));
    QTest::mouseRelease(handle, Qt::LeftButton, {}, middle);
    QVERIFY2(view_of(bench).split < 0.3, qPrintable(QString::number(view_of(bench).split)));
    QCOMPARE(bench.workbench.document().undo_stack().undoText(), QString("Split"));
    QVERIFY(std::abs(bench.find<QDoubleSpinBox>("split")->value() - view_of(bench).split) < 1e-3);

    QTest::keyClick(handle, Qt::Key_End);
    QCOMPARE(view_of(bench).split, 1.0);
    QTest::keyClick(handle, Qt::Key_Left);
    QCOMPARE(view_of(bench).split, 0.99);
    QTest::keyClick(handle, Qt::Key_Left, Qt::ShiftModifier);
    QVERIFY(std::abs(view_of(bench).split - 0.89) < 1e-9);
}

void ModelSceneTest::pictures_are_saved_as_shown() {
    Bench bench;
    QVERIFY_THROWS_EXCEPTION(Error, bench.scene.save_picture(path("early.png")));
    bench.begin();
    bench.set("roughness", 0.25);
    bench.scene.save_picture(path("shown.png"));
    const QImage saved(path("shown.png"));
    QCOMPARE(saved.size(), QSize(320, 240));
    QVERIFY(saved.pixelColor(200, 80).lightness() > 200);  // towards the light
    QCOMPARE(saved.text("asperity:model"), QString("sphere"));
    QVERIFY(saved.text("asperity:brdf").startsWith("cook-torrance:roughness=0.25"));
    QVERIFY(saved.text("asperity:samples").toInt() >= 1);

    bench.scene.save_picture(path("linear.exr"));
    const Image linear = io::read_image(path("linear.exr").toStdString());
    QCOMPARE(linear.width, 320);
    QVERIFY(luminance(linear.at(200, 80)) > 1);
    QVERIFY_THROWS_EXCEPTION(Error, bench.scene.save_picture(path("shown.jpg")));
    QVERIFY(!QFile::exists(path("shown.jpg")));
}

void ModelSceneTest::camera_type_is_a_setting() {
    Bench bench;
    bench.begin();
    bench.change([](ModelView& view) { view.camera_type = CameraType::FirstPerson; });
    const Vec3 before = bench.scene.viewport().camera().position;
    QTest::keyPress(&bench.scene.viewport(), Qt::Key_W);
    QTRY_VERIFY_WITH_TIMEOUT(!(bench.scene.viewport().camera().position == before), 60000);
    QTest::keyRelease(&bench.scene.viewport(), Qt::Key_W);
}

void ModelSceneTest::it_closes_while_a_brdf_is_made() {
    io::save_measurement(small_measurement(), path("closing.asperity").toStdString());
    QElapsedTimer clock;
    {
        Bench bench;
        bench.begin();
        bench.change([this](ModelView& view) {
            view.brdf.type = BrdfType::Simulated;
            view.brdf.result = path("closing.asperity").toStdString();
        });
        QTest::qWait(20);
        clock.start();
    }
    QVERIFY2(clock.elapsed() < 400, "four parts with threads, 100 ms each");
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::ModelSceneTest)
#include "model_scene_test.moc"
