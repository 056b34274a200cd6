// SPDX-License-Identifier: Apache-2.0
// Every analytic model of the library can be worn and drawn beside a measurement, one that a
// program adds at run time too: no file of the studio knows their names.
#include "model/session_text.h"
#include "model_testing.h"
#include "view/plot_canvas.h"
#include "view/plots_panel.h"

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/lobe_slice.h>
#include <asperity/params/fields.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLineEdit>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

/// "Velvet", of a program that uses the library: f = tint (1 - cos(theta_i))^p (1 - cos(theta_o))^p
/// / pi, where p = 1 / alpha.
struct VelvetSettings {
    double alpha = 0.5;
    std::vector<double> tint = {1};
    bool inverted = false;
};

class Velvet final : public Bsdf {
  public:
    explicit Velvet(const VelvetSettings& settings) : settings_(settings) {}

    int channels() const override { return static_cast<int>(settings_.tint.size()); }
    std::string name() const override { return "velvet:"; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        const bool above = wi.z > 0 && wo.z > 0;
        const double p = 1 / settings_.alpha;
        const double grazing = std::pow((1 - wi.z) * (1 - wo.z), p);
        for (std::size_t c = 0; c < f.size(); ++c)
            f[c] = above ? settings_.tint[c] * (settings_.inverted ? 1 - grazing : grazing) / kPi
                         : 0.0;
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        const double r = std::sqrt(u1), phi = 2 * kPi * u2;
        const Vec3 wo{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u1)};
        return wi.z > 0 ? std::optional(BsdfSample{wo, wo.z / kPi}) : std::nullopt;
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return wi.z > 0 ? std::max(wo.z, 0.0) / kPi : 0; }

  private:
    VelvetSettings settings_;
};

BsdfModel velvet() {
    using S = VelvetSettings;
    return bsdf_model<S>(
        "velvet", "Velvet", "bright at grazing angles",
        {field(&S::alpha, {.name = "alpha", .range = {0.01, 100}, .doc = "width"}),
         field(&S::tint, {.name = "tint", .range = kZeroToOne, .doc = "colour"}),
         field(&S::inverted, {.name = "inverted", .doc = "bright where it is dark"})},
        [](const S& s) { return std::make_unique<Velvet>(s); });
}

}  // namespace

class ModelChoicesTest : public QObject {
    Q_OBJECT

  private slots:
    void initTestCase();
    void all_models_are_choices();
    void a_model_of_a_program_is_worn();
    void models_keep_their_settings();
    void what_cannot_be_made_is_said();
    void sessions_hold_all_models();
    void older_sessions_open();
    void sessions_refuse_data();
    void sessions_refuse();
    void a_model_of_a_program_is_drawn_beside_layers();
    void further_settings_of_an_overlay();

  private:
    QStringList header(PlotsPanel& panel, PlotKind kind);
    Workbench plotted_;
    QTemporaryDir folder_;
};

void ModelChoicesTest::initTestCase() {
    QVERIFY(!find_bsdf_model("velvet"));
    add_bsdf_model(velvet());
    StudioSettings settings;
    settings.experiment.surface.kind = "gaussian";
    settings.experiment.surface.size = 64;
    settings.experiment.optics.fresnel = FresnelKind::Conductor;
    settings.experiment.optics.material = "Au";
    settings.experiment.run.jitter = 8;
    settings.experiment.illumination.layers = 3;
    settings.experiment.detector.resolution = 32;
    settings.surface_view.current_layer = 2;
    plotted_.document().reset(settings);
    QTRY_VERIFY_WITH_TIMEOUT(!plotted_.surface().busy(), 60000);
    plotted_.draw_to_textures();
    QTRY_VERIFY_WITH_TIMEOUT(plotted_.drawing().layers().complete, 120000);
}

void ModelChoicesTest::all_models_are_choices() {
    Bench bench;
    for (const char* name : {"brdf-type", "second-brdf-type"}) {
        auto* type = bench.find<QComboBox>(name);
        QStringList entries;
        for (int k = 0; k < type->count(); ++k) entries << type->itemText(k);
        QCOMPARE(entries, QStringList({"Lambert", "Cook-Torrance", "GGX", "Beckmann", "Student-T",
                                       "ABg", "Velvet", "Simulated"}));
    }
    QCOMPARE(bench.find<QComboBox>("brdf-type")->currentText(), QString("Cook-Torrance"));
    // Each can be worn as it comes.
    bench.begin();
    for (const BsdfModel& model : bsdf_models()) {
        bench.find<QComboBox>("brdf-type")->setCurrentText(QString::fromStdString(model.label));
        QCOMPARE(bench.workbench.settings().model_view.brdf.model, model.name);
        QVERIFY2(bench.scene.stage().message().isEmpty(), model.name.c_str());
        const auto sight = bench.scene.stage().sight();
        QVERIFY(sight->scene.material.brdf().name().starts_with(model.name + ":"));
        QVERIFY(bench.scene.stage().left_name().startsWith(QString::fromStdString(model.label)));
    }
}

void ModelChoicesTest::a_model_of_a_program_is_worn() {
    Bench bench;
    bench.begin();
    const Film metal = paint(bench.scene);
    bench.find<QComboBox>("brdf-type")->setCurrentText("Velvet");
    const Film white = paint(bench.scene);
    QVERIFY(!same(white, metal));
    // Its fields are made from its rows: a number, a colour, a flag
    QVERIFY(bench.find<QDoubleSpinBox>("alpha")->isVisible());
    QCOMPARE(bench.find<QDoubleSpinBox>("alpha")->maximum(), 100.0);
    bench.set("tint-g", 0);
    bench.set("tint-b", 0);
    const Film red = paint(bench.scene);
    for (int y = 0; y < red.height(); ++y)
        for (int x = 0; x < red.width(); ++x) {
            const Rgb was = white.at(x, y).mean, is = red.at(x, y).mean;
            if (was.r > 0.3 && was.r == is.r) QVERIFY(is.g <= was.g);
        }
    QVERIFY(!same(red, white));
    bench.find<QCheckBox>("inverted")->setChecked(true);
    QVERIFY(!same(paint(bench.scene), red));
    QCOMPARE(bench.workbench.document().undo_stack().undoText(), QString("Inverted"));
    bench.workbench.document().undo_stack().undo();
    QVERIFY(same(paint(bench.scene), red));
    QVERIFY(!bench.find<QCheckBox>("inverted")->isChecked());
}

void ModelChoicesTest::models_keep_their_settings() {
    Bench bench;
    auto* type = bench.find<QComboBox>("brdf-type");
    type->setCurrentText("GGX");
    bench.set("alpha", 0.25);
    bench.find<QComboBox>("masking")->setCurrentText("Separable");
    auto* material = bench.find<QLineEdit>("material");
    material->setText("Au");
    emit material->editingFinished();
    type->setCurrentText("Student-T");
    QCOMPARE(bench.find<QDoubleSpinBox>("alpha")->value(), 0.5);
    bench.set("gamma", 4);
    type->setCurrentText("GGX");
    QCOMPARE(bench.find<QDoubleSpinBox>("alpha")->value(), 0.25);
    bench.begin();
    // The same model as on the command line.
    QCOMPARE(bench.scene.stage().sight()->scene.material.brdf().name(),
             parse_brdf_spec("ggx:alpha=0.25,masking=separable,material=Au")->name());
    QCOMPARE(bench.scene.stage().left_name(),
             QString("GGX, alpha 0.25, masking separable, material Au"));
    // The second BRDF has settings of its own.
    QVERIFY(!bench.workbench.settings().model_view.second.settings.contains("ggx"));
}

void ModelChoicesTest::what_cannot_be_made_is_said() {
    Bench bench;
    bench.begin();
    bench.find<QComboBox>("brdf-type")->setCurrentText("GGX");
    bench.find<QComboBox>("fresnel")->setCurrentText("Conductor");  // of what is not said
    std::string cli;
    try {
        parse_brdf_spec("ggx:alpha=0.5,fresnel=conductor");
    } catch (const Error& error) {
        cli = error.what();
    }
    QVERIFY(!cli.empty());
    QCOMPARE(bench.scene.stage().message(), QString::fromStdString(cli));
    auto* material = bench.find<QLineEdit>("material");
    material->setText("Cu");
    emit material->editingFinished();
    QVERIFY(bench.scene.stage().message().isEmpty());
    // A comma would part settings: the old text comes back.
    material->setText("Cu,Au");
    emit material->editingFinished();
    QCOMPARE(material->text(), QString("Cu"));
}

void ModelChoicesTest::sessions_hold_all_models() {
    StudioSettings settings;
    BrdfSettings& brdf = settings.model_view.brdf;
    brdf.model = "velvet";
    brdf.settings["velvet"] = {{"tint", "0.5/0.25/0.125"}, {"inverted", "true"}};
    brdf.settings["ggx"] = {{"alpha", "0.3"}};
    brdf.settings["cook-torrance"] = {{"roughness", "0.7"}, {"k", "ibl"}};
    settings.plots.overlays["velvet"] = {true, 0.125};
    settings.plots.overlays["ggx"] = {true, 0.25};
    settings.plots.overlay_settings["student-t"] = {{"gamma", "5"}};
    const std::string text = session_text(settings);
    QVERIFY(text.find("\nbrdf-type = velvet\n") != std::string::npos);
    QVERIFY(text.find("\nbrdf-roughness = 0.7\n") != std::string::npos);
    QVERIFY(text.find("\nplot-ggx = true\n") != std::string::npos);
    const StudioSettings again = session_from_text(text, "session");
    QCOMPARE(session_text(again), text);
    QCOMPARE(again.model_view.brdf.model, brdf.model);
    QCOMPARE(again.model_view.brdf.settings.at("velvet").size(), brdf.settings["velvet"].size());
    QVERIFY(again.model_view.brdf.settings.at("velvet") == brdf.settings["velvet"]);
    QVERIFY(again.plots.overlay("velvet") == settings.plots.overlay("velvet"));
    QVERIFY(again.plots.overlay_settings == settings.plots.overlay_settings);
    // What is as by default is not written, so that older programs read it.
    const std::string usual = session_text({});
    for (const char* key :
         {"brdf-models", "second-models", "plot-models", "plot-alphas", "plot-model-settings"})
        QVERIFY2(usual.find(key) == std::string::npos, key);
}

void ModelChoicesTest::older_sessions_open() {
    // As the studio wrote it before models were rows.
    const StudioSettings s = session_from_text(
        "[studio]\nbrdf-type = cook-torrance\nbrdf-metallic = 0.25\nbrdf-roughness = 0\n"
        "brdf-albedo = 1,0.5,0.25\nbrdf-normalize-factor = 1\nbrdf-diffuse = 0,0,0\n"
        "second-type = simulated\nsecond-metallic = 1\nsecond-roughness = 0.4\n"
        "second-albedo = 1,1,1\nsecond-normalize-factor = 2\nsecond-diffuse = 0,0,0\n"
        "plot-cook-torrance = false\ncook-torrance-alpha = 0.3\nplot-ggx = true\n"
        "ggx-alpha = 0.125\nplot-beckmann = false\nbeckmann-alpha = 0.3\n",
        "old.txt");
    const BrdfSettings& brdf = s.model_view.brdf;
    QVERIFY(brdf.type == BrdfType::Model && brdf.model == "cook-torrance");
    const SpecSettings expected = {
        {"roughness", "0.01"}, {"metallic", "0.25"}, {"albedo", "1/0.5/0.25"}};
    QVERIFY(brdf.settings.at("cook-torrance") == expected);
    QVERIFY(s.model_view.second.type == BrdfType::Simulated);
    QCOMPARE(s.model_view.second.normalize_factor, 2.0);
    QVERIFY(!s.plots.overlay("cook-torrance").shown && !s.plots.overlay("beckmann").shown);
    QVERIFY((s.plots.overlay("ggx") == Overlay{true, 0.125}));
}

void ModelChoicesTest::sessions_refuse_data() {
    QTest::addColumn<QString>("line");
    QTest::addColumn<QString>("why");
    const auto row = [](const char* line, const char* why) { QTest::newRow(line) << line << why; };
    const QString models = "lambert, cook-torrance, ggx, beckmann, student-t, abg, velvet";
    QTest::newRow("type") << "brdf-type = phong"
                          << "brdf-type: 'phong' is none of " + models + ", simulated";
    QTest::newRow("model") << "brdf-models = phong:n=3"
                           << "brdf-models: 'phong' is not a model; there are " + models;
    row("second-models = ggx:shine=3", "second-models: 'shine=3' is no setting of the model ggx");
    row("brdf-models = ggx:alpha=0", "brdf-models: ggx: alpha: '0' must be in 0.0001 .. 100");
    row("brdf-models = alpha=0.3",
        "brdf-models: 'alpha=0.3' does not begin with a model's name and ':'");
    row("brdf-models = ggx:alpha=1,alpha=2", "brdf-models: alpha of ggx is set twice");
    row("brdf-models = cook-torrance:roughness=1",
        "brdf-models: roughness of cook-torrance is set by brdf-roughness");
    row("plot-models = ggx", "plot-models: ggx is shown by plot-ggx");
    row("plot-alphas = velvet=0", "plot-alphas: '0' must be in 0.0001 .. 100");
    row("plot-alphas = ggx=0.5", "plot-alphas: the width of ggx is set by ggx-alpha");
}

void ModelChoicesTest::sessions_refuse() {
    QFETCH(QString, line);
    QFETCH(QString, why);
    QString said = "nothing";
    try {
        session_from_text("[studio]\n" + line.toStdString() + "\n", "lost.txt");
    } catch (const Error& error) {
        said = error.what();
    }
    QCOMPARE(said, "lost.txt:2: " + why);
}

QStringList ModelChoicesTest::header(PlotsPanel& panel, PlotKind kind) {
    plotted_.document().change("Plot Kind", [&](StudioSettings& s) { s.plots.kind = kind; });
    QTest::qWait(250);
    const QString path = folder_.filePath("plot.csv");
    panel.save(path);
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readLine()).trimmed().split(',')
                                          : QStringList();
}

void ModelChoicesTest::a_model_of_a_program_is_drawn_beside_layers() {
    PlotsPanel panel(plotted_);
    panel.resize(640, 640);
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    panel.findChild<QCheckBox*>("follow-surface")->setChecked(false);
    QVERIFY(panel.findChild<QDoubleSpinBox*>("lambert-alpha") == nullptr);  // it has no width
    panel.findChild<QCheckBox*>("show-velvet")->setChecked(true);
    panel.findChild<QDoubleSpinBox*>("velvet-alpha")->setValue(0.25);
    const QString column = "Velvet α = 0.25: f [1/sr]";
    QTRY_VERIFY_WITH_TIMEOUT(header(panel, PlotKind::LobeCartesian).contains(column), 60000);
    QTRY_VERIFY_WITH_TIMEOUT(
        header(panel, PlotKind::Albedo).contains("Velvet α = 0.25: albedo [1]"), 60000);
    panel.findChild<QCheckBox*>("show-student-t")->setChecked(true);
    // It has no facets; Student's t has.
    QTRY_VERIFY_WITH_TIMEOUT(
        header(panel, PlotKind::Normals).contains("Student-T α = 0.3: D [1/sr]"), 60000);
    for (const QString& name : header(panel, PlotKind::Normals)) QVERIFY(!name.contains("Velvet"));

    // The numbers are those of the model, p = 4, one channel beside three: the cosine-weighted mean
    // of (1 - cos)^4 over a row of cells, with v = 1 - cos an elementary integral.
    const auto mean = [](double from, double to) {
        const auto integral = [](double theta) {
            const double v = 1 - std::cos(theta);
            return std::pow(v, 5) / 5 - std::pow(v, 6) / 6;
        };
        const double s1 = std::sin(from), s2 = std::sin(to);
        return (integral(to) - integral(from)) / ((s2 * s2 - s1 * s1) / 2);
    };
    QVERIFY(header(panel, PlotKind::LobeCartesian).contains(column));
    QFile file(folder_.filePath("plot.csv"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const qsizetype k = QString::fromUtf8(file.readLine()).trimmed().split(',').indexOf(column);
    const double theta_i = plotted_.drawing().layers().layer(2)->theta_i;
    int rows = 0;
    while (!file.atEnd()) {
        const QStringList row = QString::fromUtf8(file.readLine()).trimmed().split(',');
        const double theta_o = radians(std::abs(row[0].toDouble())), half = kPi / 4 / 16;
        const double f = std::pow(1 - std::cos(theta_i), 4) * mean(theta_o - half, theta_o + half);
        QVERIFY2(std::abs(row[k].toDouble() - f / kPi) <= 3e-3 * f + 1e-10,
                 qPrintable(row.join(' ')));
        ++rows;
    }
    QCOMPARE(rows, 32);
}

void ModelChoicesTest::further_settings_of_an_overlay() {
    PlotsPanel panel(plotted_);
    panel.resize(640, 640);
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    plotted_.document().change("Plots", [](StudioSettings& s) {
        s.plots.overlays = {{"student-t", {true, 0.5}}};
        s.plots.follow_surface = false;
    });
    panel.findChild<QToolButton*>("more-student-t")->click();
    auto* gamma = panel.findChild<QDoubleSpinBox*>("plot-student-t-gamma");
    QVERIFY(gamma != nullptr);
    QVERIFY(panel.findChild<QWidget*>("plot-student-t-alpha") == nullptr);  // the slider's
    gamma->setValue(2);
    const QString column = "Student-T α = 0.5; gamma = 2: f [1/sr]";
    QTRY_VERIFY_WITH_TIMEOUT(header(panel, PlotKind::LobeCartesian).contains(column), 60000);
    QFile file(folder_.filePath("plot.csv"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const qsizetype k = QString::fromUtf8(file.readLine()).trimmed().split(',').indexOf(column);
    // gamma = 2 is GGX, whose facets are the measurement's gold unless set otherwise.
    const LobeSlice slice =
        lobe_slice(*parse_brdf_spec("ggx:alpha=0.5,material=Au"), *plotted_.drawing().layers().head,
                   *plotted_.drawing().layers().layer(2), -1);
    for (const LobeSample& sample : slice.samples) {
        const QStringList row = QString::fromUtf8(file.readLine()).trimmed().split(',');
        QVERIFY(std::abs(row[k].toDouble() - sample.f) <= 1e-9 * sample.f);
    }
}

}  // namespace asperity::studio

QTEST_MAIN(asperity::studio::ModelChoicesTest)
#include "model_choices_test.moc"
