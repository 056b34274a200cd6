// SPDX-License-Identifier: Apache-2.0
#include "simulation_fields.h"

#include "../model/facet_choices.h"
#include "../model/settings_keys.h"
#include "param_control.h"

#include <asperity/gonio/experiment.h>

#include <QSignalBlocker>

#include <cmath>
#include <memory>
#include <vector>

namespace asperity::studio {

namespace {

/// Shown digits end here; files may hold fewer rays a cell.
constexpr double kLeastJitter = 0.001;

int layer_count(const Workbench& workbench) {
    return static_cast<int>(incidences(workbench.incident_light()).size());
}

}  // namespace

TextureFields::TextureFields(Workbench& workbench, QWidget* parent)
    : Section(tr("Texture Settings"), parent),
      bindings_(workbench.document(), this),
      lock_(workbench, this) {
    auto* sizes = new QComboBox;
    sizes->setObjectName("texture-resolution");
    sizes->setToolTip(
        tr("Texels of a sky-map across and down. Its upper half, resolution columns by half as "
           "many rows, is the hemisphere that light is sorted into"));
    for (const int size : {32, 64, 128, 256, 512, 1024, 2048, 4096})
        sizes->addItem(QString("%1x%1").arg(size), size);
    form().addRow(tr("Texture Resolution"), sizes);
    lock_.add(sizes);

    bindings_.follow([sizes](const StudioSettings& settings) {
        const QSignalBlocker quiet(sizes);
        const int size = settings.experiment.detector.resolution;
        // A session may have one of its own
        if (sizes->findData(size) < 0) sizes->addItem(QString("%1x%1").arg(size), size);
        sizes->setCurrentIndex(sizes->findData(size));
    });
    connect(sizes, &QComboBox::currentIndexChanged, this, [&workbench, sizes](int index) {
        workbench.document().change(tr("Texture Resolution"), [&](StudioSettings& settings) {
            settings.experiment.detector.resolution = sizes->itemData(index).toInt();
        });
    });
}

SimulationFields::SimulationFields(Workbench& workbench, QWidget* parent)
    : Section(tr("Simulation Settings"), parent),
      workbench_(workbench),
      bindings_(workbench.document(), this),
      lock_(workbench, this) {
    add_rays();
    add_layer();
    add_facets();
}

void SimulationFields::add_rays() {
    const Param<StudioSettings>& row = *asperity::find(all_params(), "jitter");
    auto* jitter = new NumberBox(kLeastJitter, row.info.range.high, 3, 1);
    add_named_row(tr("Camera Jitter"), jitter, tooltip_of(row));
    lock_.add(jitter);
    const auto read = [this](const StudioSettings& s) {
        return jitter_of(s.experiment.run, workbench_.surface().cells());
    };
    connect(&workbench_.surface(), &SurfaceSource::ready, this, [this, jitter, read] {
        const QSignalBlocker quiet(jitter);
        jitter->setValue(read(workbench_.settings()));
    });
    bindings_.bind(jitter, tr("Camera Jitter"), read, [](StudioSettings& s, double value) {
        s.experiment.run.jitter = value;
        s.experiment.run.rays = 0;
    });
    add_setting("surfaces");
    add_setting("bounces");
    add_setting("layers");
    add_setting("theta");
}

void SimulationFields::add_setting(const char* name) {
    const Param<StudioSettings>& param = *asperity::find(all_params(), name);
    const QString label = QString::fromStdString(asperity::label(param.info));
    QWidget* const control = make_control(param, label, bindings_, workbench_.document());
    add_named_row(label, control, tooltip_of(param));
    lock_.add(control);
}

void SimulationFields::add_layer() {
    auto* layer = new SliderField("current-layer", 1, 15, 0, 1);
    add_named_row(
        tr("Current Layer"), layer,
        tr("The sky-map that dome, beam, paths and plots show. Layer k of 15 is lit from an "
           "elevation of 6k degrees: 15 from straight above, 1 grazing"));
    const auto follow = [this, layer] { layer->set_range(1, layer_count(workbench_)); };
    bindings_.follow([follow](const StudioSettings&) { follow(); });
    connect(&workbench_.surface(), &SurfaceSource::ready, this, follow);
    bindings_.bind(
        layer, tr("Current Layer"),
        [](const StudioSettings& s) { return s.surface_view.current_layer; },
        [](StudioSettings& s, double value) {
            s.surface_view.current_layer = static_cast<int>(std::lround(value));
        });
}

void SimulationFields::add_facets() {
    auto* facets = new QComboBox;
    const auto choices = std::make_shared<const std::vector<FacetChoice>>(facet_choices());
    for (const FacetChoice& choice : *choices) facets->addItem(choice.label);
    add_named_row(
        tr("Facets"), facets,
        tr("How much a facet reflects: all (the thesis), Schlick's approximation (thesis eq. "
           "3.3), or Fresnel's equations with the index of glass or of a metal"));
    lock_.add(facets);
    bindings_.bind(
        facets, tr("Facets"),
        [choices](const StudioSettings& s) {
            return facet_choice_of(*choices, s.experiment.optics);
        },
        [choices](StudioSettings& s, int index) {
            if (index >= 0)
                s.experiment.optics = choices->at(static_cast<std::size_t>(index)).optics;
        });

    const auto first = [](const std::vector<double>& list, double otherwise) {
        return list.empty() ? otherwise : list.front();
    };
    const Param<StudioSettings>& f0_row = *asperity::find(all_params(), "f0");
    auto* f0 = new SliderField("f0", f0_row.info.range.low, f0_row.info.range.high, 3, 0.01);
    add_named_row(tr("F0"), f0, tooltip_of(f0_row));
    lock_.add(f0);
    bindings_.bind(
        f0, tr("F0"),
        [first](const StudioSettings& s) { return first(s.experiment.optics.f0, 0.04); },
        [](StudioSettings& s, double value) { s.experiment.optics.f0 = {value}; });

    const Param<StudioSettings>& index_row = *asperity::find(all_params(), "ior");
    auto* index = new NumberBox(0.001, index_row.info.range.high, 3, 0.1);
    index->setObjectName("ior");
    add_named_row(tr("Refractive Index"), index, tooltip_of(index_row));
    lock_.add(index);
    bindings_.bind(
        index, tr("Refractive Index"),
        [first](const StudioSettings& s) { return first(s.experiment.optics.ior, 1.5); },
        [](StudioSettings& s, double value) { s.experiment.optics.ior = {value}; });
    bindings_.follow([this, f0, index](const StudioSettings& settings) {
        // A law that a program added has what it was chosen with
        const OpticsSettings& optics = settings.experiment.optics;
        const bool added = optics.fresnel > FresnelKind::Conductor;
        form().setRowVisible(
            f0, optics.fresnel == FresnelKind::Schlick || (added && !optics.f0.empty()));
        form().setRowVisible(
            index, optics.fresnel == FresnelKind::Dielectric || (added && !optics.ior.empty()));
    });

    auto* isotropic = new QCheckBox(tr("Light from all azimuths"));
    isotropic->setObjectName("isotropic");
    isotropic->setToolTip(tooltip_of(*asperity::find(all_params(), "isotropic")));
    form().addRow(QString(), isotropic);
    lock_.add(isotropic);
    bindings_.bind(
        isotropic, tr("Light from all azimuths"),
        [](const StudioSettings& s) { return s.experiment.illumination.isotropic; },
        [](StudioSettings& s, bool on) { s.experiment.illumination.isotropic = on; });

    add_setting("seed");
}

}  // namespace asperity::studio
