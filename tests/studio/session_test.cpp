// SPDX-License-Identifier: Apache-2.0
// The session as text and its history: nothing is lost, nothing wrong is taken.
#include "model/document.h"
#include "model/facet_choices.h"
#include "model/session_text.h"
#include "model/settings_keys.h"

#include <asperity/core/error.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/optics/fresnel.h>
#include <asperity/optics/materials.h>
#include <asperity/optics/scattering_law.h>

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <map>

namespace asperity::studio {
namespace {

/// A text other than the default that the setting takes, tried out from what there is.
std::string another_value(const Param<StudioSettings>& key) {
    const StudioSettings defaults;
    const std::string usual = key.text(defaults);
    for (const char* text : {"true",
                             "false",
                             "0.125",
                             "3",
                             "0.25,0.5,0.75",
                             "model",
                             "first-person",
                             "lit",
                             "viridis",
                             "0,0,3,0,0,-1,0,1,0,40",
                             "log",
                             "linear",
                             "disk",
                             "simulated",
                             "cook-torrance",
                             "student-t",
                             "student-t=0.5",
                             "f0",
                             "single",
                             "lambert:albedo=0.5",
                             "sky",
                             "aces",
                             "srgb",
                             "albedo",
                             "a \"quoted\" name # no comment.asperity"}) {
        StudioSettings settings;
        try {
            key.apply(settings, text);
        } catch (const Error&) {
            continue;
        }
        if (key.text(settings) != usual) return text;
    }
    return usual;
}

QString sentence(const std::string& text) {
    try {
        session_from_text(text, "lost.txt");
    } catch (const Error& error) {
        return error.code() == ErrorCode::InvalidInput ? error.what() : "another code";
    }
    return "nothing thrown";
}

}  // namespace

class SessionTest : public QObject {
    Q_OBJECT

  private slots:
    void every_key_survives_data();
    void every_key_survives();
    void all_keys_together();
    void experiment_survives();
    void names_are_unique();
    void refuses_data();
    void refuses();
    void config_of_the_cli_is_a_session();

    void change_undo_redo();
    void one_movement_is_one_step();
    void back_and_forth_is_no_step();
    void changes_within_changes();
    void open_and_save();
    void open_refuses_and_keeps();
    void facets_to_choose_are_all_laws();
};

void SessionTest::every_key_survives_data() {
    QTest::addColumn<QString>("name");
    for (const Param<StudioSettings>& key : studio_params())
        QTest::newRow(key.info.name.c_str()) << QString::fromStdString(key.info.name);
}

void SessionTest::every_key_survives() {
    QFETCH(QString, name);
    const Param<StudioSettings>& key = *find(studio_params(), name.toStdString());
    const std::string value = another_value(key);

    StudioSettings settings;
    key.apply(settings, value);
    QVERIFY(key.text(settings) != key.text(StudioSettings{}));

    const std::string text = session_text(settings);
    const StudioSettings again = session_from_text(text, "session");
    QCOMPARE(key.text(again), key.text(settings));
    QCOMPARE(session_text(again), text);
    // One key is one field: all others are as they were
    for (const Param<StudioSettings>& other : studio_params())
        if (other.info.name != key.info.name)
            QCOMPARE(other.text(again), other.text(StudioSettings{}));
}

void SessionTest::all_keys_together() {
    StudioSettings settings;
    for (const Param<StudioSettings>& key : studio_params()) {
        const std::string value = another_value(key);
        key.apply(settings, value);
    }
    settings.model_view.light_position = {0.1, 1e-300, -2.0 / 3};
    settings.model_view.model = "/models with spaces/a\nb\\c.obj";
    const StudioSettings again = session_from_text(session_text(settings), "session");
    for (const Param<StudioSettings>& key : studio_params())
        QCOMPARE(key.text(again), key.text(settings));
    QCOMPARE(again.model_view.light_position.z, -2.0 / 3);
    QCOMPARE(again.model_view.model, settings.model_view.model);
}

void SessionTest::experiment_survives() {
    StudioSettings settings;
    settings.experiment.surface.kind = "gaussian";
    settings.experiment.surface.alpha_x = 0.1;
    settings.experiment.illumination.theta_deg = {10, 20.5};
    settings.experiment.optics.material = "Au";
    settings.experiment.run.jitter = 1.0 / 3;
    const StudioSettings again = session_from_text(session_text(settings), "session");
    QCOMPARE(to_text(again.experiment), to_text(settings.experiment));
    QCOMPARE(again.experiment.run.jitter, 1.0 / 3);
}

void SessionTest::names_are_unique() {
    std::map<std::string, int> times;
    for (const Param<StudioSettings>& key : studio_params()) ++times[key.info.name];
    for (const auto& [name, count] : times) QVERIFY2(count == 1, name.c_str());
    QVERIFY(find(studio_params(), "no-such-key") == nullptr);
}

void SessionTest::refuses_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("why");
    const auto row = [](const char* name, const char* text, const char* why) {
        QTest::newRow(name) << text << why;
    };
    row("unknown", "[studio]\nspin = 3\n", "lost.txt:2: spin: there is no such setting");
    row("a key of the experiment in the wrong place", "\n\n[studio]\nroughness = 1\n",
        "lost.txt:4: roughness: there is no such setting");
    row("a key of the studio in the wrong place", "current-layer = 3\n",
        "lost.txt:1: current-layer: there is no such setting");
    row("range", "[studio]\nsplit = 1.5\n", "lost.txt:2: split: '1.5' must be in 0 .. 1");
    row("layer", "[studio]\ncurrent-layer = 0\n",
        "lost.txt:2: current-layer: '0' must be in 1 .. 9000");
    row("choice", "[studio]\nshading = shiny\n",
        "lost.txt:2: shading: 'shiny' is none of normals, lit");
    row("nan", "[studio]\nexposure = nan\n", "lost.txt:2: exposure: 'nan' is not a number");
    row("two numbers", "[studio]\nbrdf-albedo = 1,1\n",
        "lost.txt:2: brdf-albedo: '1,1' is not three numbers");
    row("twice", "[studio]\ndome = true\ndome = false\n", "lost.txt:3: 'dome' is set twice");
    row("experiment", "bounces = many\n", "lost.txt:1: bounces: 'many' is not a whole number");
}

void SessionTest::refuses() {
    QFETCH(QString, text);
    QFETCH(QString, why);
    QCOMPARE(sentence(text.toStdString()), why);
}

void SessionTest::config_of_the_cli_is_a_session() {
    const StudioSettings settings =
        session_from_text("# a run\nsurface = flat\nlayers = 3\n\n[elsewhere]\nx = y\n", "run.txt");
    QCOMPARE(settings.experiment.surface.kind, std::string("flat"));
    QCOMPARE(settings.experiment.illumination.layers, 3);
    QCOMPARE(settings.surface_view.current_layer, StudioSettings{}.surface_view.current_layer);
}

void SessionTest::change_undo_redo() {
    Document document;
    QSignalSpy changed(&document, &Document::changed);
    document.change("Surface Roughness", [](auto& s) { s.experiment.surface.roughness = 0.7; });
    document.change("Ray Bounces", [](auto& s) { s.experiment.run.bounces = 3; });
    QCOMPARE(changed.count(), 2);
    QCOMPARE(document.undo_stack().undoText(), "Ray Bounces");
    QVERIFY(document.modified());

    document.undo_stack().undo();
    QCOMPARE(document.settings().experiment.run.bounces, Experiment{}.run.bounces);
    QCOMPARE(document.settings().experiment.surface.roughness, 0.7);
    document.undo_stack().undo();
    QCOMPARE(session_text(document.settings()), session_text({}));
    QVERIFY(!document.modified());
    document.undo_stack().redo();
    document.undo_stack().redo();
    QCOMPARE(document.settings().experiment.run.bounces, 3);
    QCOMPARE(changed.count(), 6);

    document.change("Nothing", [](auto&) {});
    QCOMPARE(changed.count(), 6);
    QCOMPARE(document.undo_stack().count(), 2);

    document.reset({});
    QCOMPARE(document.undo_stack().count(), 0);
    QCOMPARE(changed.count(), 7);
}

void SessionTest::one_movement_is_one_step() {
    Document document;
    const auto roughness = [&](double value) {
        document.change("Surface Roughness",
                        [=](auto& s) { s.experiment.surface.roughness = value; });
    };
    for (int k = 1; k <= 10; ++k) roughness(0.05 * k + 0.3);
    QCOMPARE(document.undo_stack().count(), 1);
    document.change("Ray Bounces", [](auto& s) { s.experiment.run.bounces = 3; });
    roughness(0.9);
    QCOMPARE(document.undo_stack().count(), 3);  // another name in between: another movement
    QTest::qWait(1100);
    roughness(0.95);
    QCOMPARE(document.undo_stack().count(), 4);  // later: another movement

    document.undo_stack().setIndex(0);
    QCOMPARE(document.settings().experiment.surface.roughness, 0.2);
    document.undo_stack().redo();
    QCOMPARE(document.settings().experiment.surface.roughness, 0.05 * 10 + 0.3);
}

void SessionTest::back_and_forth_is_no_step() {
    Document document;
    const auto split = [&](double value) {
        document.change("Split", [=](auto& s) { s.model_view.split = value; });
    };
    document.change("Floor", [](auto& s) { s.model_view.floor = true; });
    split(0.6);
    split(0.5);
    QCOMPARE(document.undo_stack().count(), 1);
    QCOMPARE(document.undo_stack().undoText(), "Floor");
    QCOMPARE(document.settings().model_view.split, 0.5);
}

void SessionTest::changes_within_changes() {
    Document document;
    // A listener that keeps the layer within the layers there are
    connect(&document, &Document::changed, &document, [&] {
        const int layers = document.settings().experiment.illumination.layers;
        if (document.settings().surface_view.current_layer > layers)
            document.change("Current Layer",
                            [=](auto& s) { s.surface_view.current_layer = layers; });
    });
    document.change("Layers", [](auto& s) { s.experiment.illumination.layers = 5; });
    QCOMPARE(document.settings().surface_view.current_layer, 5);
    QCOMPARE(document.undo_stack().count(), 2);
    document.undo_stack().setIndex(0);
    QCOMPARE(session_text(document.settings()), session_text({}));
}

void SessionTest::open_and_save() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("mîrror 1.txt");
    Document document;
    QSignalSpy path_changed(&document, &Document::path_changed);
    document.change("Ray Bounces", [](auto& s) { s.experiment.run.bounces = 7; });
    document.save(path);
    QVERIFY(!document.modified());
    QCOMPARE(document.path(), path);
    QCOMPARE(path_changed.count(), 1);
    document.undo_stack().undo();
    QVERIFY(document.modified());

    Document other;
    other.open(path);
    QCOMPARE(other.settings().experiment.run.bounces, 7);
    QCOMPARE(other.path(), path);
    QVERIFY(!other.modified());
    QCOMPARE(other.undo_stack().count(), 0);
}

void SessionTest::open_refuses_and_keeps() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("bad.txt");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("bounces = 4\nbounces = 5\n");
    file.close();
    Document document;
    document.change("Ray Bounces", [](auto& s) { s.experiment.run.bounces = 7; });
    QVERIFY_THROWS_EXCEPTION(Error, document.open(path));
    QVERIFY_THROWS_EXCEPTION(Error, document.open(folder.filePath("missing.txt")));
    QVERIFY_THROWS_EXCEPTION(Error, document.save(folder.filePath("no/such/folder.txt")));
    QCOMPARE(document.settings().experiment.run.bounces, 7);
    QCOMPARE(document.undo_stack().count(), 1);
    QVERIFY(document.path().isEmpty());
}

void SessionTest::facets_to_choose_are_all_laws() {
    ScatteringLaw half;
    half.name = "half";
    half.label = "Half mirrors";
    half.channels = [](const OpticsSettings& s) {
        if (s.ior.empty()) throw Error(ErrorCode::Usage, "is missing", "ior");
        return std::vector<FacetChannel>{{0.5, s.ior[0], 0}};
    };
    half.reflectance = [](double, const FacetChannel& channel) { return channel.f0; };
    const FresnelKind kind = add_scattering_law(half);

    const std::vector<FacetChoice> choices = facet_choices();
    QCOMPARE(choices.size(), 3 + materials().size() + 1);
    for (std::size_t k = 0; k < choices.size(); ++k) {
        QCOMPARE(facet_choice_of(choices, choices[k].optics), static_cast<int>(k));
        QVERIFY(Fresnel(choices[k].optics).channels() >= 1);
    }
    QCOMPARE(choices.front().label, QString("Perfect mirrors"));
    QCOMPARE(choices.back().label, QString("Half mirrors"));
    QVERIFY(choices.back().optics.fresnel == kind);
    QCOMPARE(choices.back().optics.ior, std::vector<double>{1.5});

    OpticsSettings given;
    given.fresnel = FresnelKind::Conductor;
    given.ior = {0.2};
    given.k = {3};
    QCOMPARE(facet_choice_of(choices, given), -1);
    // A name that decides nothing does not matter
    OpticsSettings mirrors;
    mirrors.material = "Au";
    QCOMPARE(facet_choice_of(choices, mirrors), 0);
}

}  // namespace asperity::studio

QTEST_GUILESS_MAIN(asperity::studio::SessionTest)
#include "session_test.moc"
