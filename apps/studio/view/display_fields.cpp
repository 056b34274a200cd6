// SPDX-License-Identifier: Apache-2.0
#include "display_fields.h"

namespace asperity::studio {

namespace {

QCheckBox* make_check(const char* name, const QString& label, const QString& tooltip) {
    auto* box = new QCheckBox(label);
    box->setObjectName(name);
    box->setToolTip(tooltip);
    return box;
}

QComboBox* make_list(const char* name, const QStringList& items, const QString& tooltip) {
    auto* list = new QComboBox;
    list->setObjectName(name);
    list->addItems(items);
    list->setToolTip(tooltip);
    return list;
}

}  // namespace

DisplayFields::DisplayFields(Workbench& workbench, QWidget* parent)
    : Section(tr("Display"), parent), bindings_(workbench.document(), this) {
    add_surface();
    add_light();
    add_colours();
}

void DisplayFields::add_surface() {
    auto* shading =
        make_list("surface-shading", {tr("Normals"), tr("Lit relief")},
                  tr("Colours of the surface: the thesis' red = |n_x|, green = |n_z|, blue = "
                     "|n_y|, or a relief lit from the side and tinted by height"));
    form().addRow(tr("Surface"), shading);
    bindings_.bind(
        shading, tr("Surface Shading"),
        [](const StudioSettings& s) { return static_cast<int>(s.surface_view.shading); },
        [](StudioSettings& s, int index) {
            s.surface_view.shading = static_cast<SurfaceShading>(index);
        });
}

void DisplayFields::add_light() {
    const auto add = [this](QCheckBox* box, bool SurfaceView::*field) {
        form().addRow(QString(), box);
        bindings_.bind(
            box, box->text(), [field](const StudioSettings& s) { return s.surface_view.*field; },
            [field](StudioSettings& s, bool on) { s.surface_view.*field = on; });
    };
    add(make_check("show-lobe", tr("Lobe"),
                   tr("The current layer as a solid over the surface: it reaches as far into each "
                      "direction as f stands high on the colour bar; grey where f is not known "
                      "well")),
        &SurfaceView::lobe);
    add(make_check("show-model-lobes", tr("Lobes of models"),
                   tr("The models that the plots show as shells in the light of the same layer, on "
                      "the scale of the layer's own lobe, in the colours of their curves")),
        &SurfaceView::model_lobes);
    add(make_check("show-dome", tr("Dome"), tr("The sky-map of the current layer, all around")),
        &SurfaceView::dome);
    add(make_check("show-beam", tr("Beam"), tr("The incident light as a wireframe")),
        &SurfaceView::beam);
    add(make_check("show-paths", tr("Paths of light"),
                   tr("Sample rays of the current layer, coloured by bounce. Click a cell of the "
                      "dome or of a plot for the paths that end in it")),
        &SurfaceView::paths);

    auto* count = new QSpinBox;
    count->setObjectName("path-count");
    count->setRange(1, 5000);
    count->setToolTip(tr("How many paths are drawn"));
    form().addRow(tr("Number of Paths"), count);
    bindings_.bind(
        count, tr("Number of Paths"),
        [](const StudioSettings& s) { return s.surface_view.path_count; },
        [](StudioSettings& s, int value) { s.surface_view.path_count = value; });
}

void DisplayFields::add_colours() {
    auto* colours =
        make_list("colour-map", {tr("Viridis"), tr("Inferno"), tr("Grey"), tr("Thesis red")},
                  tr("Colours of the dome"));
    form().addRow(tr("Dome Colours"), colours);
    bindings_.bind(
        colours, tr("Dome Colours"),
        [](const StudioSettings& s) { return static_cast<int>(s.surface_view.sky_map.colour_map); },
        [](StudioSettings& s, int index) {
            s.surface_view.sky_map.colour_map = static_cast<io::ColourMap>(index);
        });

    auto* scale = make_list("dome-scale", {tr("Logarithmic"), tr("Linear")},
                            tr("How the BRDF [1/sr] becomes a colour"));
    form().addRow(tr("Dome Scale"), scale);
    bindings_.bind(
        scale, tr("Dome Scale"),
        [](const StudioSettings& s) { return static_cast<int>(s.surface_view.sky_map.scale); },
        [](StudioSettings& s, int index) {
            s.surface_view.sky_map.scale = static_cast<io::Scale>(index);
        });

    auto* decades = new NumberBox(0.5, 12, 1, 0.5);
    decades->setObjectName("decades");
    decades->setToolTip(tr("Powers of ten from the darkest to the brightest colour"));
    form().addRow(tr("Decades"), decades);
    bindings_.bind(
        decades, tr("Decades"),
        [](const StudioSettings& s) { return s.surface_view.sky_map.decades; },
        [](StudioSettings& s, double value) { s.surface_view.sky_map.decades = value; });
    bindings_.follow([this, decades](const StudioSettings& settings) {
        form().setRowVisible(decades, settings.surface_view.sky_map.scale == io::Scale::Log);
    });
}

}  // namespace asperity::studio
