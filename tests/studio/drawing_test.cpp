// SPDX-License-Identifier: Apache-2.0
// Draw To Textures: layers that grow, stop, pause, and the same result as the command line's.
#include "model/drawing.h"
#include "model/document.h"

#include <asperity/core/error.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measure.h>

#include <QElapsedTimer>
#include <QProcess>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <optional>
#include <vector>

namespace asperity::studio {
namespace {

using State = Drawing::State;

constexpr int kSoon = 60000;  // milliseconds, also on a busy machine

Experiment small_experiment() {
    Experiment experiment;
    experiment.surface.size = 120;
    experiment.detector.resolution = 64;
    experiment.run.jitter = 4;
    return experiment;
}

/// Takes so long that nobody waits for its end.
Experiment endless_experiment() {
    Experiment experiment = small_experiment();
    experiment.run.jitter = 1e5;
    return experiment;
}

std::shared_ptr<const Heightfield> surface_of(const Experiment& experiment) {
    Run run;
    return std::make_shared<Heightfield>(io::load_surface(experiment.surface, run));
}

QString checksum_of(const Experiment& experiment) {
    Run run;
    return QString::fromStdString(io::checksum(measure(*surface_of(experiment), experiment, run)));
}

bool starts_growing(Drawing& drawing) {
    return QTest::qWaitFor([&] { return !drawing.layers().by_number.empty(); }, kSoon);
}

#ifdef ASPERITY_CLI
const QString kCli = ASPERITY_CLI;
#else
const QString kCli;  // the ordinary build makes the comparison
#endif

/// Runs the program on a session and returns the checksum it prints, or else its error.
QString checksum_of_the_cli(const QString& session) {
    QProcess cli;
    cli.start(kCli, {"simulate", "--config", session});
    if (!cli.waitForFinished(kSoon) || cli.exitCode() != 0) return cli.readAllStandardError();
    const QString printed = cli.readAllStandardOutput();
    return printed.section("checksum ", 1).trimmed();
}

}  // namespace

class DrawingTest : public QObject {
    Q_OBJECT

  private slots:
    void draws_from_15_to_1();
    void layers_grow();
    void stop_clears_and_answers();
    void stops_while_preparing();
    void pause_keeps();
    void starts_anew_while_drawing();
    void same_as_the_command_line_data();
    void same_as_the_command_line();
    void refuses_as_the_command_line();
    void opens_a_result();
    void refuses_before_it_begins();
    void fails_with_a_sentence();
};

void DrawingTest::draws_from_15_to_1() {
    const Experiment experiment = small_experiment();
    Drawing drawing;
    QSignalSpy completed(&drawing, &Drawing::completed), state(&drawing, &Drawing::state_changed);
    std::vector<int> begun;
    connect(&drawing, &Drawing::layers_changed, &drawing, [&](int number) {
        if (number == 0) return;
        QVERIFY(drawing.layers().head != nullptr);
        QVERIFY(drawing.layers().layer(number) != nullptr);
        if (begun.empty() || begun.back() != number) begun.push_back(number);
    });
    QVERIFY(drawing.layers().head == nullptr);

    drawing.start(surface_of(experiment), experiment);
    QCOMPARE(drawing.state(), State::Drawing);
    QVERIFY(completed.wait(kSoon));
    QCOMPARE(drawing.state(), State::Idle);
    QCOMPARE(state.count(), 2);

    std::vector<int> all(15);
    std::generate(all.begin(), all.end(), [k = 16]() mutable { return --k; });
    QCOMPARE(begun, all);
    QVERIFY(drawing.layers().complete);
    QCOMPARE(drawing.layers().by_number.size(), 15U);
    QCOMPARE(drawing.layers().head->detector.columns(), 64);
    QVERIFY(drawing.layers().head->layers.empty());
    QCOMPARE(drawing.result()->layers.size(), 15U);
    QCOMPARE(drawing.layers().layer(3), &drawing.result()->layers[12]);
    QCOMPARE(drawing.checksum(), checksum_of(experiment));

    drawing.clear();
    QVERIFY(drawing.layers().head == nullptr && drawing.layers().by_number.empty());
    QVERIFY(drawing.result() == nullptr && drawing.checksum().isEmpty());
}

void DrawingTest::layers_grow() {
    const Experiment experiment = endless_experiment();
    Drawing drawing;
    std::vector<std::uint64_t> rays;
    connect(&drawing, &Drawing::layers_changed, &drawing, [&](int number) {
        if (number == 15) rays.push_back(drawing.layers().layer(15)->rays);
    });
    QSignalSpy progressed(&drawing, &Drawing::progressed);
    drawing.start(surface_of(experiment), experiment);
    QVERIFY(QTest::qWaitFor([&] { return rays.size() >= 3; }, kSoon));
    QVERIFY(std::is_sorted(rays.begin(), rays.end()));
    QVERIFY(rays.front() > 0 && rays.front() < rays.back());
    QVERIFY(!drawing.layers().complete && drawing.result() == nullptr);
    QVERIFY(progressed.count() > 0);
    QCOMPARE(drawing.progress().stage, std::string("tracing"));
    QVERIFY(drawing.progress().seconds_left > 0);
}

void DrawingTest::stop_clears_and_answers() {
    Experiment experiment = endless_experiment();
    experiment.surface.size = 512;
    experiment.run.jitter = 4000;
    experiment.detector.resolution = 512;
    std::optional<Drawing> drawing(std::in_place);
    drawing->start(surface_of(experiment), experiment);
    QVERIFY(starts_growing(*drawing));

    QElapsedTimer timer;
    timer.start();
    drawing->stop();
    const qint64 answered = timer.elapsed();
    QCOMPARE(drawing->state(), State::Idle);
    QVERIFY(drawing->layers().by_number.empty() && drawing->layers().head == nullptr);
    QTest::qWait(300);  // nothing arrives late
    QVERIFY(drawing->layers().by_number.empty() && drawing->layers().head == nullptr);

    drawing->start(surface_of(experiment), experiment);
    QVERIFY(starts_growing(*drawing));
    timer.start();
    drawing.reset();
    qInfo("stop: %lld ms, closing during a run: %lld ms", answered, timer.elapsed());
    QVERIFY(answered < 100 && timer.elapsed() < 1000);
}

void DrawingTest::stops_while_preparing() {
    Experiment experiment = endless_experiment();
    experiment.surface.size = 2048;
    experiment.run.jitter = 100;
    const auto surface = surface_of(experiment);
    std::optional<Drawing> drawing(std::in_place);
    drawing->start(surface, experiment);
    QVERIFY(QTest::qWaitFor([&] { return drawing->progress().stage == "preparing"; }, kSoon));
    QElapsedTimer timer;
    timer.start();
    drawing.reset();
    qInfo("closing while the tracer prepares: %lld ms", timer.elapsed());
    QVERIFY(timer.elapsed() < 1000);
}

void DrawingTest::pause_keeps() {
    Experiment experiment = small_experiment();
    experiment.run.jitter = 40;
    Drawing drawing;
    QSignalSpy completed(&drawing, &Drawing::completed);
    drawing.pause();
    QCOMPARE(drawing.state(), State::Idle);  // there is nothing to pause

    drawing.start(surface_of(experiment), experiment);
    QVERIFY(starts_growing(drawing));
    drawing.pause();
    QCOMPARE(drawing.state(), State::Paused);
    QTest::qWait(200);  // what was under way ends
    const auto kept = drawing.layers().by_number;
    const Progress before = drawing.progress();
    QTest::qWait(300);
    QCOMPARE(drawing.progress().done, before.done);
    QCOMPARE(drawing.progress().seconds, before.seconds);
    QVERIFY(drawing.layers().by_number == kept && !kept.empty());
    QCOMPARE(completed.count(), 0);

    drawing.resume();
    QCOMPARE(drawing.state(), State::Drawing);
    QVERIFY(completed.wait(kSoon));
    QCOMPARE(drawing.checksum(), checksum_of(experiment));

    // A pause does not keep a stop from coming through
    drawing.start(surface_of(experiment), experiment);
    drawing.pause();
    drawing.stop();
    QCOMPARE(drawing.state(), State::Idle);
}

void DrawingTest::starts_anew_while_drawing() {
    Drawing drawing;
    QSignalSpy completed(&drawing, &Drawing::completed);
    drawing.start(surface_of(endless_experiment()), endless_experiment());
    QVERIFY(starts_growing(drawing));
    drawing.start(surface_of(small_experiment()), small_experiment());
    QVERIFY(drawing.layers().by_number.empty());
    QVERIFY(completed.wait(kSoon));
    QCOMPARE(drawing.checksum(), checksum_of(small_experiment()));
    QCOMPARE(completed.count(), 1);
}

void DrawingTest::same_as_the_command_line_data() {
    QTest::addColumn<bool>("copper");
    QTest::addColumn<bool>("isotropic");
    QTest::newRow("copper") << true << false;
    QTest::newRow("mirrors") << false << true;
}

void DrawingTest::same_as_the_command_line() {
    QFETCH(bool, copper);
    QFETCH(bool, isotropic);
    const QTemporaryDir folder;
    Document document;
    document.change("All", [&](StudioSettings& s) {
        s.experiment = small_experiment();
        s.experiment.surface.roughness = 0.35;
        s.experiment.illumination.layers = 5;
        s.experiment.illumination.isotropic = isotropic;
        s.experiment.optics.fresnel = copper ? FresnelKind::Conductor : FresnelKind::None;
        s.experiment.optics.material = copper ? "Cu" : "";
        s.model_view.model = "knot";
        s.surface_view.current_layer = 3;
    });
    document.save(folder.filePath("session.txt"));

    Drawing drawing;
    QSignalSpy completed(&drawing, &Drawing::completed);
    const Experiment& experiment = document.settings().experiment;
    drawing.start(surface_of(experiment), experiment);
    QVERIFY(completed.wait(kSoon));
    QCOMPARE(drawing.checksum().size(), 32);
    if (kCli.isEmpty()) return;
    QCOMPARE(checksum_of_the_cli(document.path()), drawing.checksum());
}

void DrawingTest::refuses_as_the_command_line() {
    const QTemporaryDir folder;
    Document document;
    document.change("Material", [](StudioSettings& s) {
        s.experiment = small_experiment();
        s.experiment.optics.material = "Cu";  // of perfect mirrors
    });
    document.save(folder.filePath("session.txt"));
    QString sentence;
    try {
        Drawing().start(surface_of(small_experiment()), document.settings().experiment);
    } catch (const Error& error) {
        sentence = error.what();
    }
    QCOMPARE(sentence, "material: has no meaning with fresnel none");
    if (kCli.isEmpty()) return;
    const QString printed = checksum_of_the_cli(document.path()).trimmed();
    QVERIFY2(printed.contains(sentence), qPrintable(printed));
}

void DrawingTest::opens_a_result() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("résult.asperity");
    Experiment experiment = small_experiment();
    experiment.illumination.theta_deg = {0, 30};
    experiment.illumination.phi_deg = {0, 90};
    Run run;
    const Measurement m = measure(*surface_of(experiment), experiment, run);
    io::save_measurement(m, path.toStdString());

    Drawing drawing;
    drawing.start(surface_of(endless_experiment()), endless_experiment());
    drawing.open(path);
    QCOMPARE(drawing.state(), State::Idle);
    QVERIFY(drawing.layers().complete);
    QCOMPARE(drawing.layers().by_number.size(), 4U);
    QCOMPARE(drawing.checksum().toStdString(), io::checksum(m));

    QVERIFY_THROWS_EXCEPTION(Error, drawing.open(folder.filePath("none.asperity")));
    QCOMPARE(drawing.layers().by_number.size(), 4U);
}

void DrawingTest::refuses_before_it_begins() {
    Drawing drawing;
    Experiment experiment = small_experiment();
    const auto surface = surface_of(experiment);
    experiment.run.bounces = 0;
    QVERIFY_THROWS_EXCEPTION(Error, drawing.start(surface, experiment));
    experiment = small_experiment();
    experiment.optics.fresnel = FresnelKind::Conductor;
    experiment.optics.material = "cheese";
    QVERIFY_THROWS_EXCEPTION(Error, drawing.start(surface, experiment));
    QVERIFY_THROWS_EXCEPTION(Error, drawing.start(nullptr, small_experiment()));
    QCOMPARE(drawing.state(), State::Idle);
}

void DrawingTest::fails_with_a_sentence() {
    Drawing drawing;
    QSignalSpy failed(&drawing, &Drawing::failed);
    Experiment experiment = small_experiment();
    experiment.run.jitter = 1e9;
    drawing.start(surface_of(experiment), experiment);
    QVERIFY(failed.wait(kSoon));
    const QString sentence = failed.front().front().toString();
    QVERIFY2(sentence.startsWith("jitter: 1000000000 launch points per cell"),
             qPrintable(sentence));
    QCOMPARE(drawing.state(), State::Idle);
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::DrawingTest)
#include "drawing_test.moc"
