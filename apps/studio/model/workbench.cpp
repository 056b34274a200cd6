// SPDX-License-Identifier: Apache-2.0
#include "workbench.h"

#include "words.h"

#include <asperity/core/error.h>
#include <asperity/gonio/angles_of_lobe.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/params/settings_text.h>
#include <asperity/surface/surface_params.h>

#include <vector>

namespace asperity::studio {
namespace {

// Settings are equal if and only if their texts are.

template <typename Settings>
bool same(const ParamTable<Settings>& table, const Settings& a, const Settings& b) {
    return settings_text(table, a) == settings_text(table, b);
}

bool same_experiment(const Experiment& a, const Experiment& b) {
    return same(experiment_params(), a, b);
}

bool same_surface(const SurfaceSettings& a, const SurfaceSettings& b) {
    return same(surface_params(), a, b);
}

bool same_detector(const DetectorSettings& a, const DetectorSettings& b) {
    return a.kind == b.kind && a.resolution == b.resolution;
}

}  // namespace

Workbench::Workbench(QObject* parent) : QObject(parent) {
    connect(&document_, &Document::changed, this, &Workbench::follow_settings);
    connect(&surface_, &SurfaceSource::ready, this, &Workbench::surface_ready);
    connect(&surface_, &SurfaceSource::failed, this, [this](const QString& sentence) {
        set_waiting(false);
        complain(in_words_of_forms(sentence));
    });
    connect(&drawing_, &Drawing::failed, this, &Workbench::complain);
    connect(&drawing_, &Drawing::state_changed, this, &Workbench::drawing_changed);
    // Another experiment: the cell looked at was one of the former's
    connect(&drawing_, &Drawing::layers_changed, this, [this](int number) {
        if (number == 0) select_cell(std::nullopt);
    });
    surface_.make(settings().experiment.surface);
}

void Workbench::draw_to_textures() {
    // The surface of the settings could not be made: the older one still there is not theirs
    const bool fits =
        surface_.surface() && same_surface(surface_.settings(), settings().experiment.surface);
    if (!fits && !surface_.busy()) surface_.make(settings().experiment.surface);
    if (surface_.busy())
        set_waiting(true);
    else
        begin_drawing();
}

void Workbench::stop_drawing() {
    set_waiting(false);
    drawing_.stop();
}

bool Workbench::are_layers_current() const {
    const auto& head = drawing_.layers().head;
    if (!head) return false;
    Experiment wanted = settings().experiment;
    wanted.run.jitter = jitter_of(wanted.run, head->surface_cells);
    wanted.run.surfaces = surfaces_of(wanted.run, head->surface_cells);
    // Angles set by the lobe follow from what else is compared
    if (IlluminationSettings& light = wanted.illumination;
        light.layers == 0 && light.theta_deg.empty() && head->experiment.illumination.layers == 0)
        light.theta_deg = head->experiment.illumination.theta_deg;
    return same_experiment(head->experiment, wanted);
}

IlluminationSettings Workbench::incident_light() const {
    IlluminationSettings light = settings().experiment.illumination;
    if (light.layers != 0 || !light.theta_deg.empty()) return light;
    light.layers = IlluminationSettings{}.layers;
    if (!surface_.surface()) return light;
    try {
        light.theta_deg =
            angles_of_lobe(surface_.statistics().rms_gradient, settings().experiment.optics);
    } catch (const Error&) {  // optics that are being typed
    }
    return light;
}

bool Workbench::is_drawing() const {
    return draw_when_ready_ || drawing_.state() != Drawing::State::Idle;
}

void Workbench::select_cell(std::optional<int> cell) {
    if (cell == cell_) return;
    cell_ = cell;
    emit cell_selected();
    look_for_paths();
}

void Workbench::log(const QString& line) {
    log_.append(line);
    emit logged(line);
}

void Workbench::follow_settings(const StudioSettings& before) {
    const StudioSettings& now = settings();
    if (!same_detector(before.experiment.detector, now.experiment.detector))
        select_cell(std::nullopt);
    if (!same_surface(before.experiment.surface, now.experiment.surface)) {
        surface_.make(now.experiment.surface);  // paths follow when it is ready
        return;
    }
    const SurfaceView &then = before.surface_view, &view = now.surface_view;
    if (then.paths != view.paths || then.path_count != view.path_count ||
        then.current_layer != view.current_layer ||
        !same_experiment(before.experiment, now.experiment))
        look_for_paths();
}

void Workbench::look_for_paths() {
    const SurfaceView& view = settings().surface_view;
    if ((!view.paths && !cell_) || !surface_.surface()) {
        light_.forget();
        return;
    }
    Experiment experiment = settings().experiment;
    experiment.surface = surface_.settings();
    experiment.illumination = incident_light();
    // A cell is one of the layers that are shown, whatever the settings say by now
    const auto& shown = drawing_.layers().head;
    if (cell_ && shown) experiment.detector = shown->experiment.detector;
    light_.look({surface_.surface(), experiment, view.current_layer,
                 static_cast<std::size_t>(view.path_count), cell_});
}

void Workbench::surface_ready() {
    look_for_paths();
    if (!draw_when_ready_) return;
    begin_drawing();
    set_waiting(false);
}

void Workbench::begin_drawing() {
    try {
        drawing_.start(surface_.surface(), settings().experiment);
    } catch (const Error& error) {
        complain(QString::fromUtf8(error.what()));
    }
}

void Workbench::set_waiting(bool waiting) {
    if (waiting == draw_when_ready_) return;
    draw_when_ready_ = waiting;
    emit drawing_changed();
}

void Workbench::complain(const QString& sentence) {
    log(sentence);
    emit complaint(sentence);
}

}  // namespace asperity::studio
