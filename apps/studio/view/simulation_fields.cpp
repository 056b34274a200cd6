// SPDX-License-Identifier: Apache-2.0
#include "simulation_fields.h"

#include <asperity/gonio/experiment.h>
#include <asperity/optics/materials.h>

#include <QSignalBlocker>

#include <cmath>
#include <limits>

namespace asperity::studio {

namespace {

/// The metals by name; the list of facets begins with the kinds that are no metals.
struct Metal {
    const char* symbol;
    const char* name;
};
constexpr Metal kMetals[] = {{"Al", "Aluminium"}, {"Ag", "Silver"},  {"Au", "Gold"},
                             {"Cu", "Copper"},    {"Cr", "Chrome"},  {"Fe", "Iron"},
                             {"Ni", "Nickel"},    {"Ti", "Titanium"}};
enum Facets { kMirrors, kSchlick, kDielectric, kFirstMetal };

int facets_of(const OpticsSettings& optics) {
    switch (optics.fresnel) {
        case FresnelKind::None:
            return kMirrors;
        case FresnelKind::Schlick:
            return kSchlick;
        case FresnelKind::Dielectric:
            return kDielectric;
        case FresnelKind::Conductor:
            for (int metal = 0; metal < static_cast<int>(std::size(kMetals)); ++metal)
                if (optics.material == kMetals[metal].symbol) return kFirstMetal + metal;
    }
    return -1;  // a conductor of given indices: from a session, no entry of the list
}

OpticsSettings optics_of(int facets) {
    OpticsSettings optics;
    if (facets == kSchlick) {
        optics.fresnel = FresnelKind::Schlick;
        optics.f0 = {0.04};
    } else if (facets == kDielectric) {
        optics.fresnel = FresnelKind::Dielectric;
        optics.ior = {1.5};
    } else if (facets >= kFirstMetal) {
        optics.fresnel = FresnelKind::Conductor;
        optics.material = kMetals[facets - kFirstMetal].symbol;
    }
    return optics;
}

int layer_count(const IlluminationSettings& light) {
    if (light.theta_deg.empty()) return light.layers;
    return static_cast<int>(light.theta_deg.size() * light.phi_deg.size());
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
    for (const int size : {32, 64, 128, 256, 512}) sizes->addItem(QString("%1x%1").arg(size), size);
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
    auto* jitter = new NumberBox(1, 4096, 2, 1);
    add_named_row(tr("Camera Jitter"), jitter,
                  tr("How often the light camera is shifted by less than a cell: rays per cell and "
                     "layer. Twice as many, errors smaller by sqrt(2)"));
    lock_.add(jitter);
    bindings_.bind(
        jitter, tr("Camera Jitter"),
        [](const StudioSettings& s) { return s.experiment.run.jitter; },
        [](StudioSettings& s, double value) {
            s.experiment.run.jitter = value;
            s.experiment.run.rays = 0;
        });

    auto* bounces = new QSpinBox;
    bounces->setRange(1, 10000);
    add_named_row(
        tr("Ray Bounces"), bounces,
        tr("How often a ray may be reflected; the energy of one that is still travelling then "
           "is counted as truncated"));
    lock_.add(bounces);
    bindings_.bind(
        bounces, tr("Ray Bounces"),
        [](const StudioSettings& s) { return s.experiment.run.bounces; },
        [](StudioSettings& s, int value) { s.experiment.run.bounces = value; });
}

void SimulationFields::add_layer() {
    auto* layer = new SliderField("current-layer", 1, 15, 0, 1);
    add_named_row(
        tr("Current Layer"), layer,
        tr("The sky-map that dome, beam, paths and plots show. Layer k of 15 is lit from an "
           "elevation of 6k degrees: 15 from straight above, 1 grazing"));
    bindings_.follow([layer](const StudioSettings& settings) {
        layer->set_range(1, layer_count(settings.experiment.illumination));
    });
    bindings_.bind(
        layer, tr("Current Layer"),
        [](const StudioSettings& s) { return s.surface_view.current_layer; },
        [](StudioSettings& s, double value) {
            s.surface_view.current_layer = static_cast<int>(std::lround(value));
        });
}

void SimulationFields::add_facets() {
    auto* facets = new QComboBox;
    facets->addItems({tr("Perfect mirrors"), tr("Schlick, F0"), tr("Dielectric, index")});
    for (const Metal& metal : kMetals)
        facets->addItem(QString("%1 (%2)").arg(metal.name, metal.symbol));
    add_named_row(
        tr("Facets"), facets,
        tr("How much a facet reflects: all (the thesis), Schlick's approximation (thesis eq. "
           "3.3), or Fresnel's equations with the index of glass or of a metal"));
    lock_.add(facets);
    bindings_.bind(
        facets, tr("Facets"),
        [](const StudioSettings& s) { return facets_of(s.experiment.optics); },
        [](StudioSettings& s, int index) { s.experiment.optics = optics_of(index); });

    const auto first = [](const std::vector<double>& list, double otherwise) {
        return list.empty() ? otherwise : list.front();
    };
    auto* f0 = new SliderField("f0", 0, 1, 3, 0.01);
    add_named_row(tr("F0"), f0, tr("Reflectance along the normal, 0 .. 1 (thesis eq. 3.3)"));
    lock_.add(f0);
    bindings_.bind(
        f0, tr("F0"),
        [first](const StudioSettings& s) { return first(s.experiment.optics.f0, 0.04); },
        [](StudioSettings& s, double value) { s.experiment.optics.f0 = {value}; });

    auto* index = new NumberBox(0.01, 100, 3, 0.1);
    index->setObjectName("ior");
    add_named_row(tr("Refractive Index"), index, tr("Inside against outside; glass has about 1.5"));
    lock_.add(index);
    bindings_.bind(
        index, tr("Refractive Index"),
        [first](const StudioSettings& s) { return first(s.experiment.optics.ior, 1.5); },
        [](StudioSettings& s, double value) { s.experiment.optics.ior = {value}; });
    bindings_.follow([this, f0, index](const StudioSettings& settings) {
        const int kind = facets_of(settings.experiment.optics);
        form().setRowVisible(f0, kind == kSchlick);
        form().setRowVisible(index, kind == kDielectric);
    });

    auto* isotropic = new QCheckBox(tr("Light from all azimuths"));
    isotropic->setObjectName("isotropic");
    isotropic->setToolTip(
        tr("Every ray comes from an azimuth of its own, outgoing ones are counted from it: best "
           "for surfaces that are the same from all sides, such as models wear"));
    form().addRow(QString(), isotropic);
    lock_.add(isotropic);
    bindings_.bind(
        isotropic, tr("Light from all azimuths"),
        [](const StudioSettings& s) { return s.experiment.illumination.isotropic; },
        [](StudioSettings& s, bool on) { s.experiment.illumination.isotropic = on; });

    auto* seed = new QSpinBox;
    seed->setRange(0, std::numeric_limits<int>::max());
    add_named_row(tr("Seed"), seed, tr("Of the rays. Same settings and seed, same bits"));
    lock_.add(seed);
    bindings_.bind(
        seed, tr("Seed"),
        [](const StudioSettings& s) { return static_cast<int>(s.experiment.run.seed); },
        [](StudioSettings& s, int value) {
            s.experiment.run.seed = static_cast<std::uint64_t>(value);
        });
}

}  // namespace asperity::studio
