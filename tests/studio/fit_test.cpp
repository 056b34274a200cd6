// SPDX-License-Identifier: Apache-2.0
// The dialog Fit: the truth is found, and a fit goes on into the plots and the comparison.
#include "dialogs_testing.h"

#include "model/model_settings.h"
#include "view/fit_table.h"
#include "view/model_scene.h"
#include "view/plot_overlays.h"

#include <shared/write_materialx.h>

#include <QClipboard>

namespace asperity::studio::testing {

class FitTest : public QObject {
    Q_OBJECT

  private slots:
    void init() { window_ = std::make_unique<DialogsWindow>(); }
    void cleanup() { window_.reset(); }

    void is_in_the_menu();
    void fits_find_the_truth();
    void a_fit_goes_into_the_plots();
    void a_fit_goes_into_the_comparison();
    void a_diffuse_part_is_added();
    void a_fit_is_saved_as_materialx();
    void fit_settings_are_kept();
    void fitting_can_be_stopped();
    void errors_have_two_digits();
    void lobes_stand_beside_each_other();
    void screenshots();

  private:
    DialogsWindow& window() { return *window_; }

    TestScope scope_;
    std::unique_ptr<DialogsWindow> window_;
};

void FitTest::is_in_the_menu() {
    FitDialog& dialog = window().fitting();
    QVERIFY(dialog.isVisible());
    auto& button = window().control<QPushButton>("fit-begin");
    QVERIFY(!button.isEnabled() && button.toolTip().contains("Draw To Textures"));
    QVERIFY(window().draw());
    QVERIFY(button.isEnabled());
    window().click("close-fit");
    QVERIFY(!dialog.isVisible());
}

void FitTest::fits_find_the_truth() {
    const QString file = window().ggx_file(scope_);
    FitDialog& dialog = window().fitting();
    dialog.source().set_source({BrdfSource::Kind::File, file.toStdString()});
    window().only({"ggx", "lambert"});
    window().fit(dialog);
    QVERIFY2(dialog.outcome() != nullptr,
             qPrintable(window().control<QLabel>("fit-message").text()));
    QCOMPARE(dialog.table().topLevelItemCount(), 2);
    QCOMPARE(dialog.table().topLevelItem(0)->text(0), QString("ggx"));  // best first
    const Fit& best = dialog.outcome()->report.fits.front();
    QCOMPARE(best.params.front().key, std::string("alpha"));
    QVERIFY2(std::abs(best.params.front().value - 0.3) < 0.006,
             qPrintable(QString::number(best.params.front().value)));
    QCOMPARE(dialog.table().topLevelItem(0)->child(0)->text(0),
             "alpha = " + with_error(best.params.front().value, best.params.front().error));
    QVERIFY(!window().control<QLabel>("fit-verdict").text().isEmpty());
    window().click("fit-copy");
    QCOMPARE(QApplication::clipboard()->text(), QString::fromStdString(best.spec));
}

void FitTest::a_fit_goes_into_the_plots() {
    window().workbench().document().change("Test", [](StudioSettings& s) {
        Experiment& e = s.experiment;
        e.surface.kind = "gaussian";
        e.surface.size = 256;
        e.surface.alpha_x = e.surface.alpha_y = 0.3;
        e.optics.fresnel = FresnelKind::Conductor;
        e.optics.material = "Au";
        e.illumination.isotropic = true;
        e.run.jitter = 4;
    });
    QVERIFY(window().surface_comes());
    QVERIFY(window().draw());
    FitDialog& dialog = window().fitting();
    window().only({"beckmann", "ggx"});
    window().fit(dialog);
    QVERIFY(dialog.outcome() != nullptr);
    const Fit best = dialog.outcome()->report.fits.front();
    QCOMPARE(best.text, std::string("beckmann"));  // the slopes are Gaussian
    QVERIFY2(std::abs(best.params.front().value - 0.3) < 0.03,
             qPrintable(QString::number(best.params.front().value)));
    QVERIFY(best.params.front().error > 0);
    const auto result = window().workbench().drawing().result();
    const auto shown = [&] {
        const double alpha = window().workbench().surface().statistics().rms_gradient;
        return overlay_models(window().workbench().settings().plots, alpha, result.get());
    };
    const auto before = shown();
    window().click("fit-to-plots");
    const auto after = shown();
    QCOMPARE(after.size(), before.size() + 1);
    for (const OverlayModel& model : after) {
        if (model.name == "beckmann")
            QVERIFY(apart(*parse_brdf_spec(model.spec), *parse_brdf_spec(best.spec)) < 1e-4);
        for (const OverlayModel& other : before)  // nothing else changes
            if (other.name == model.name)
                QVERIFY(apart(*parse_brdf_spec(model.spec), *parse_brdf_spec(other.spec)) < 1e-9);
    }
    window().workbench().document().undo_stack().undo();
    QCOMPARE(shown().size(), before.size());
}

void FitTest::a_fit_goes_into_the_comparison() {
    const QString file = window().ggx_file(scope_);
    FitDialog& dialog = window().fitting();
    dialog.source().set_source({BrdfSource::Kind::File, file.toStdString()});
    window().only({"cook-torrance"});
    window().fit(dialog);
    QVERIFY2(dialog.outcome() != nullptr,
             qPrintable(window().control<QLabel>("fit-message").text()));
    const std::string spec = dialog.outcome()->report.fits.front().spec;
    window().click("fit-to-compare");
    const StudioSettings& settings = window().workbench().settings();
    QVERIFY(settings.scene == SceneKind::Model && settings.model_view.compare);
    QVERIFY(settings.model_view.brdf.type == BrdfType::Simulated);
    QVERIFY(settings.model_view.second.type == BrdfType::Model);
    const std::string worn = model_spec(settings.model_view.second.settings,
                                        *find_bsdf_model(settings.model_view.second.model));
    QVERIFY(apart(*parse_brdf_spec(worn), *parse_brdf_spec(spec)) < 1e-9);
    // Both are there to be seen, whether or not a model was loaded before
    QVERIFY(QTest::qWaitFor([&] { return window().model_scene().has_model(); }, 60000));
    QVERIFY(QTest::qWaitFor(
        [&] { return window().model_scene().stage().left_name() == "gold.bsdf"; }, 60000));
    QVERIFY(window().model_scene().stage().right_name().startsWith("Cook-Torrance"));
    QVERIFY(window().picture_comes());
    dialog.hide();
    shoot(window(), "compare-fit");
    window().resize(1024, 640);
    QVERIFY(window().picture_comes());
    shoot(window(), "compare-fit-small");
    window().workbench().document().undo_stack().undo();
    QVERIFY(window().workbench().settings().scene == SceneKind::Surface);
}

void FitTest::a_diffuse_part_is_added() {
    const QString file = window().ggx_file(scope_);
    FitDialog& dialog = window().fitting();
    dialog.source().set_source({BrdfSource::Kind::File, file.toStdString()});
    window().only({"ggx"});
    window().control<QCheckBox>("fit-lambert").click();
    QVERIFY(window().workbench().settings().fit.lambert);
    window().fit(dialog);
    QVERIFY2(dialog.outcome() != nullptr,
             qPrintable(window().control<QLabel>("fit-message").text()));
    const Fit& fit = dialog.outcome()->report.fits.front();
    QCOMPARE(fit.text, std::string("ggx plus lambert"));
    const auto found = std::find_if(fit.params.begin(), fit.params.end(),
                                    [](const FittedParam& p) { return p.key == "lambert"; });
    QVERIFY(found != fit.params.end() && found->value < 0.02);
    // OpenPBR has no place for it
    QVERIFY(!window().control<QPushButton>("fit-materialx").isEnabled());
    window().click("fit-to-plots");
    const auto& settings = window().workbench().settings().plots.overlay_settings;
    const auto kept = settings.find("ggx");
    QVERIFY(kept != settings.end());
    QVERIFY(std::any_of(kept->second.begin(), kept->second.end(),
                        [](const auto& setting) { return setting.first == "lambert"; }));
}

void FitTest::a_fit_is_saved_as_materialx() {
    const QString file = window().ggx_file(scope_);
    FitDialog& dialog = window().fitting();
    auto& button = window().control<QPushButton>("fit-materialx");
    QVERIFY(!button.isEnabled());
    dialog.source().set_source({BrdfSource::Kind::File, file.toStdString()});
    window().only({"ggx"});
    window().fit(dialog);
    QVERIFY(dialog.outcome() != nullptr);
    QVERIFY(button.isEnabled());
    const std::string path = scope_.path("gold.mtlx").toStdString();
    write_materialx(dialog.outcome()->report.fits.front(), path);
    QFile written(QString::fromStdString(path));
    QVERIFY(written.open(QIODevice::ReadOnly));
    QVERIFY(written.readAll().contains("open_pbr_surface"));
    window().only({"beckmann"});
    window().fit(dialog);
    QVERIFY(!button.isEnabled());
}

void FitTest::fit_settings_are_kept() {
    window().fitting();
    window().only({"ggx", "cook-torrance"});
    auto& list = window().control<QTreeWidget>("fit-models");
    for (int k = 0; k < list.topLevelItemCount(); ++k)
        if (list.topLevelItem(k)->data(0, Qt::UserRole) == "cook-torrance")
            list.topLevelItem(k)->setText(1, "metallic=1,k=ibl");
    window().choose("fit-metric", "Log");
    QCOMPARE(window().workbench().settings().fit.models,
             std::string("cook-torrance:metallic=1,k=ibl,ggx"));
    const QString path = scope_.path("fit.conf");
    window().workbench().document().save(path);
    window().new_session();
    QCOMPARE(window().workbench().settings().fit.models, std::string("all"));
    window().open(path);
    QCOMPARE(window().workbench().settings().fit.models,
             std::string("cook-torrance:metallic=1,k=ibl,ggx"));
    QVERIFY(window().workbench().settings().fit.metric == FitMetric::Log);
    QCOMPARE(window().control<QComboBox>("fit-metric").currentText(), QString("Log"));
}

void FitTest::fitting_can_be_stopped() {
    FitDialog& dialog = window().fitting();
    dialog.source().set_source({BrdfSource::Kind::File, window().ggx_file(scope_).toStdString()});
    QSignalSpy done(&dialog, &FitDialog::fitted);
    dialog.begin();
    QVERIFY(dialog.busy());
    window().click("fit-stop");
    QCOMPARE(done.count(), 1);
    QVERIFY(!dialog.busy() && dialog.outcome() == nullptr);
    QCOMPARE(window().control<QLabel>("fit-message").text(), QString("stopped"));
    QVERIFY(window().control<QPushButton>("fit-begin").isEnabled());
}

void FitTest::errors_have_two_digits() {
    QCOMPARE(with_error(0.301234, 0.00081), QString("0.30123 ± 0.00081"));
    QCOMPARE(with_error(12.3456, 1.2), QString("12.3 ± 1.2"));
    QCOMPARE(with_error(0.5, std::nan("")), QString("0.5 (error not known)"));
}

void FitTest::lobes_stand_beside_each_other() {
    window().draw_gold();
    QVERIFY(window().picture_comes());
    const QImage alone = window().picture();
    window().workbench().document().change("Lobes", [](StudioSettings& s) {
        s.plots.overlays["beckmann"].shown = true;
        s.surface_view.model_lobes = true;
    });
    QVERIFY(window().picture_comes());
    const QImage several = window().picture();
    const double changed = difference(alone, several);
    QVERIFY2(changed > 0.003, qPrintable(QString::number(changed)));
    // The plots decide which models; a change there is a change here
    window().workbench().document().change(
        "Models", [](StudioSettings& s) { s.plots.overlays["beckmann"].shown = false; });
    QVERIFY(window().picture_comes());
    QVERIFY(difference(several, window().picture()) > 0.001);
    window().workbench().document().undo_stack().undo();
    window().workbench().document().undo_stack().undo();
    QVERIFY(window().picture_comes());
    QVERIFY(difference(alone, window().picture()) < 0.001);
}

void FitTest::screenshots() {
    window().draw_gold();
    FitDialog& dialog = window().fitting();
    // All models, which take half a minute, where the pictures are wanted
    if (!qEnvironmentVariableIsSet("ASPERITY_SCREENSHOTS")) window().only({"beckmann", "ggx"});
    window().fit(dialog);
    QVERIFY(dialog.outcome() != nullptr);
    shoot(dialog, "fit");
    dialog.resize(900, 560);
    shoot(dialog, "fit-small");
    window().click("fit-to-plots");
    dialog.hide();
    window().workbench().document().change(
        "Test", [](StudioSettings& s) { s.surface_view.model_lobes = true; });
    QTest::qWait(1500);
    QVERIFY(window().picture_comes());
    shoot(window(), "fit-in-plots");
    QVERIFY(dialog.minimumSizeHint().width() <= 900 && dialog.minimumSizeHint().height() <= 560);
}

}  // namespace asperity::studio::testing

QTEST_MAIN(asperity::studio::testing::FitTest)
#include "fit_test.moc"
