// SPDX-License-Identifier: Apache-2.0
// What tests of the scene "Model" share.
#pragma once

#include "model/model_stage.h"
#include "view/model_panel.h"
#include "view/model_scene.h"

#include <asperity/core/run.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <memory>
#include <string>

namespace asperity::studio {

/// A canvas and its panel, on one session.
struct Bench {
    Workbench workbench;
    ModelScene scene{workbench};
    ModelPanel panel{workbench};
    QStringList complaints;

    Bench() {
        QObject::connect(&workbench, &Workbench::complaint, &scene,
                         [this](const QString& sentence) { complaints << sentence; });
        scene.resize(320, 240);
        scene.show();
        panel.show();
    }

    void change(const std::function<void(ModelView&)>& edit) {
        workbench.document().change("Test", [&](StudioSettings& s) { edit(s.model_view); });
    }

    /// Loads a model and starts the BRDF.
    void begin(const char* model = "sphere") {
        scene.load(model);
        QTRY_VERIFY_WITH_TIMEOUT(scene.has_model(), 60000);
        change([](ModelView& view) { view.brdf_runs = true; });
    }

    template <typename Control>
    Control* find(const char* name) {
        auto* control = panel.findChild<Control*>(name);
        if (control == nullptr) qFatal("there is no control named %s", name);
        return control;
    }
    /// As a user who types a value.
    void set(const char* name, double value) { find<QDoubleSpinBox>(name)->setValue(value); }
};

inline constexpr QSize kSmall{96, 72};

/// The scene as it is now, so many samples a pixel: always the same for the same settings.
inline Film paint(ModelScene& scene, int samples = 4, QSize size = kSmall) {
    const auto negative = std::make_shared<Negative>();
    const auto painting =
        paint_model(scene.stage().sight().value(), scene.viewport().camera(), negative)(size);
    Run run;
    while (painting->samples(0) < samples && painting->pass(run)) {
    }
    return negative->film();
}

inline bool same(const Film& a, const Film& b) {
    return a.image().rgb == b.image().rgb;
}

/// A measurement of a real, small surface: a second's work.
inline Measurement small_measurement() {
    Experiment experiment;
    experiment.surface.size = 120;
    experiment.detector.resolution = 32;
    experiment.run.jitter = 4;
    experiment.run.bounces = 4;
    Run run;
    return measure(make_surface(experiment.surface, run), experiment, run);
}

}  // namespace asperity::studio
