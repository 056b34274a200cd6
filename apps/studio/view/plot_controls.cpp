// SPDX-License-Identifier: Apache-2.0
#include "plot_controls.h"

#include "section.h"

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

namespace {

constexpr double kLeastAlpha = 0.01, kLargestAlpha = 2;

template <class Button>
Button* make_button(const QString& label, const QString& tooltip) {
    auto* button = new Button;
    button->setText(label);
    button->setObjectName(kebab_case(label));
    button->setToolTip(tooltip);
    return button;
}

QComboBox* make_list(const QString& name, const QStringList& items, const QString& tooltip) {
    auto* list = new QComboBox;
    list->setObjectName(kebab_case(name));
    list->setAccessibleName(name);
    list->addItems(items);
    list->setToolTip(tooltip);
    list->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    return list;
}

}  // namespace

PlotControls::PlotControls(Workbench& workbench, QWidget* parent)
    : QWidget(parent), workbench_(workbench), bindings_(workbench.document(), this) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addLayout(make_choices());
    layout->addLayout(make_models());
    bindings_.follow([this](const StudioSettings&) { update_models(); });
}

QLayout* PlotControls::make_choices() {
    auto* row = new QHBoxLayout;
    auto* kind = make_list(
        tr("Plot Kind"),
        {tr("Lobe, polar"), tr("Lobe, cartesian"), tr("Hemisphere"), tr("Albedo"), tr("Normals")},
        tr("What is plotted: the BRDF f [1/sr] of the current layer in the "
           "plane of incidence or over the hemisphere, the albedo of all "
           "layers by number of reflections, or the distribution of facet "
           "normals D [1/sr]"));
    bindings_.bind(
        kind, tr("Plot Kind"),
        [](const StudioSettings& s) { return static_cast<int>(s.plots.kind); },
        [](StudioSettings& s, int index) { s.plots.kind = static_cast<PlotKind>(index); });
    row->addWidget(kind);

    auto* scale = make_list(tr("Plot Scale"), {tr("Logarithmic"), tr("Linear")},
                            tr("Scale of the values; logarithmic over as many powers of ten as "
                               "the dome's \"Decades\""));
    bindings_.bind(
        scale, tr("Plot Scale"),
        [](const StudioSettings& s) { return static_cast<int>(s.plots.scale); },
        [](StudioSettings& s, int index) { s.plots.scale = static_cast<io::Scale>(index); });
    row->addWidget(scale);

    auto* band = make_button<QCheckBox>(
        tr("Error Band"), tr("± 1 standard error of the simulated values, estimated from the "
                             "scatter of independent batches of rays on this surface; "
                             "another surface of the same statistics may differ by more"));
    bindings_.bind(
        band, tr("Error Band"), [](const StudioSettings& s) { return s.plots.error_band; },
        [](StudioSettings& s, bool on) { s.plots.error_band = on; });
    bindings_.follow([band](const StudioSettings& s) {
        band->setEnabled(s.plots.kind != PlotKind::Hemisphere && s.plots.kind != PlotKind::Normals);
    });
    row->addWidget(band);
    row->addStretch(1);
    return row;
}

QLayout* PlotControls::make_buttons() {
    auto* row = new QHBoxLayout;
    row->addStretch(1);
    auto* copy = make_button<QToolButton>(
        tr("Copy Picture"), tr("Puts the plot on the clipboard, black on white for print"));
    auto* save = make_button<QToolButton>(
        tr("Save Plot"), tr("As a picture (PNG) or a drawing (SVG, PDF), black on white for print, "
                            "or as numbers (CSV)"));
    connect(copy, &QToolButton::clicked, this, &PlotControls::copy_wanted);
    connect(save, &QToolButton::clicked, this, &PlotControls::save_wanted);
    row->addWidget(copy);
    row->addWidget(save);
    return row;
}

QLayout* PlotControls::make_models() {
    auto* grid = new QGridLayout;
    grid->setColumnStretch(1, 1);
    add_model(*grid, 0, tr("Cook-Torrance"), &PlotView::cook_torrance);
    add_model(*grid, 1, tr("GGX"), &PlotView::ggx);
    add_model(*grid, 2, tr("Beckmann"), &PlotView::beckmann);
    auto* follow = make_button<QCheckBox>(
        tr("Follow Surface"), tr("The models take their alpha from the surface: its rms gradient, "
                                 "alpha = sqrt(2) times the rms slope along an axis"));
    bindings_.bind(
        follow, tr("Follow Surface"),
        [](const StudioSettings& s) { return s.plots.follow_surface; },
        [](StudioSettings& s, bool on) { s.plots.follow_surface = on; });
    grid->addWidget(follow, 3, 0);
    grid->addLayout(make_buttons(), 3, 1);
    return grid;
}

void PlotControls::add_model(QGridLayout& grid, int row, const QString& name,
                             Overlay PlotView::*overlay) {
    const QString note =
        overlay == &PlotView::cook_torrance
            ? tr("Thesis eq. 4.1-4.4 for a white metal; roughness = sqrt(alpha), 1 at most")
            : tr("Single reflection of a surface with this distribution of normals and facets as "
                 "simulated: f = F D G2 / (4 cos theta_i cos theta_o)");
    auto* shown = make_button<QCheckBox>(name, note);
    shown->setObjectName("show-" + kebab_case(name));
    bindings_.bind(
        shown, name, [overlay](const StudioSettings& s) { return (s.plots.*overlay).shown; },
        [overlay](StudioSettings& s, bool on) { (s.plots.*overlay).shown = on; });

    const QString label = name + " Alpha";
    auto* alpha = new SliderField(kebab_case(label), kLeastAlpha, kLargestAlpha, 3, 0.01);
    alpha->setToolTip(tr("Width alpha of the distribution of slopes") + "\n" + note);
    bindings_.bind(
        alpha, label, [overlay](const StudioSettings& s) { return (s.plots.*overlay).alpha; },
        [overlay](StudioSettings& s, double value) { (s.plots.*overlay).alpha = value; });
    grid.addWidget(shown, row, 0);
    grid.addWidget(alpha, row, 1);
    models_.push_back({overlay, alpha});
}

void PlotControls::show_surface_alpha(std::optional<double> alpha) {
    surface_alpha_ = alpha;
    update_models();
}

void PlotControls::update_models() {
    const PlotView& view = workbench_.settings().plots;
    const bool follows = view.follow_surface && surface_alpha_.has_value();
    for (const Model& model : models_) {
        const double alpha = follows ? *surface_alpha_ : (view.*model.overlay).alpha;
        model.alpha->set_range(kLeastAlpha, std::max(kLargestAlpha, alpha));
        model.alpha->set_value(alpha);
        model.alpha->setEnabled((view.*model.overlay).shown && !view.follow_surface);
    }
}

}  // namespace asperity::studio
