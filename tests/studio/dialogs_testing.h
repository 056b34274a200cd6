// SPDX-License-Identifier: Apache-2.0
// The window with its dialogs Export and Fit.
#pragma once

#include "studio_window.h"

#include "view/export_dialog.h"
#include "view/fit_dialog.h"
#include "view/theme.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>

#include <QAction>
#include <QCheckBox>
#include <QDir>
#include <QFileInfo>
#include <QSignalSpy>
#include <QTreeWidget>

#include <algorithm>
#include <cmath>
#include <memory>

namespace asperity::studio::testing {

/// Largest difference of two BRDFs of one to three channels over some directions, as a share.
inline double apart(const Bsdf& a, const Bsdf& b) {
    double most = 0;
    for (const double theta_i : {0.1, 0.7, 1.2})
        for (const double theta_o : {0.05, 0.6, 1.1})
            for (const double phi : {0.3, kPi}) {
                const Vec3 wi = from_spherical(theta_i, 0), wo = from_spherical(theta_o, phi);
                std::vector<double> fa(static_cast<std::size_t>(a.channels())),
                    fb(static_cast<std::size_t>(b.channels()));
                a.eval(wi, wo, fa);
                b.eval(wi, wo, fb);
                for (std::size_t c = 0; c < fa.size(); ++c)
                    most = std::max(most, std::abs(fa[c] - fb[std::min(c, fb.size() - 1)]) /
                                              (std::abs(fa[c]) + 1e-3));
            }
    return most;
}

inline void shoot(QWidget& widget, const QString& name) {
    QDir folder(qEnvironmentVariable("ASPERITY_SCREENSHOTS", "screenshots"));
    QVERIFY(folder.mkpath("."));
    QTest::qWait(200);
    QVERIFY(widget.grab().toImage().save(folder.filePath(name + ".png")));
}

/// A window whose layers are drawn in a moment.
class DialogsWindow : public StudioWindow {
  public:
    DialogsWindow() {
        apply_theme(Theme::Dark);
        set_small();
        if (!surface_comes()) qFatal("no surface");
    }

    QAction& action(const QString& text) {
        for (QAction* action : findChildren<QAction*>())
            if (action->text() == text) return *action;
        qFatal("no action %s", qPrintable(text));
    }
    ExportDialog& exporting() {
        action("Export BRDF...").trigger();
        return *findChild<ExportDialog*>();
    }
    FitDialog& fitting() {
        action("Fit Models...").trigger();
        return *findChild<FitDialog*>();
    }

    void write(ExportDialog& dialog, const QString& path) {
        QSignalSpy done(&dialog, &ExportDialog::exported);
        dialog.write(path);
        QVERIFY(dialog.busy());
        QVERIFY(QTest::qWaitFor([&] { return done.count() > 0; }, 120000));
    }
    void fit(FitDialog& dialog) {
        QSignalSpy done(&dialog, &FitDialog::fitted);
        QTest::mouseClick(&control<QPushButton>("fit-begin"), Qt::LeftButton);
        QVERIFY(dialog.busy());
        QVERIFY(QTest::qWaitFor([&] { return done.count() > 0; }, 120000));
    }
    void only(const QStringList& models) {
        auto& list = control<QTreeWidget>("fit-models");
        for (int k = 0; k < list.topLevelItemCount(); ++k) {
            QTreeWidgetItem* row = list.topLevelItem(k);
            const bool wanted = models.contains(row->data(0, Qt::UserRole).toString());
            row->setCheckState(0, wanted ? Qt::Checked : Qt::Unchecked);
        }
    }
    /// A file of a GGX of gold, alpha 0.3.
    QString ggx_file(const TestScope& scope) {
        const QString path = scope.path("gold.bsdf");
        if (QFileInfo::exists(path)) return path;
        ExportDialog& dialog = exporting();
        control<QComboBox>("export-source").setCurrentText("A model");
        control<QLineEdit>("export-model").setText("ggx:alpha=0.3,material=Au");
        control<QComboBox>("export-format")
            .setCurrentIndex(
                control<QComboBox>("export-format").findText("rgl", Qt::MatchStartsWith));
        write(dialog, path);
        dialog.hide();
        return path;
    }
    /// The surface that the program begins with, drawn.
    void draw_gold() {
        begin(false);
        workbench().document().change("Test", [](StudioSettings& s) {
            s.experiment.surface.size = 256;
            s.experiment.detector.resolution = 64;
            s.experiment.run.jitter = 16;
        });
        QVERIFY(surface_comes());
        QVERIFY(draw());
    }
};

}  // namespace asperity::studio::testing
