// SPDX-License-Identifier: Apache-2.0
#include "plot_controls.h"

#include "model_form.h"
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
    for (const BsdfModel& model : bsdf_models())
        add_model(*grid, static_cast<int>(models_.size()), model);
    auto* follow = make_button<QCheckBox>(
        tr("Follow Surface"), tr("The models take their alpha from the surface: its rms gradient, "
                                 "alpha = sqrt(2) times the rms slope along an axis"));
    bindings_.bind(
        follow, tr("Follow Surface"),
        [](const StudioSettings& s) { return s.plots.follow_surface; },
        [](StudioSettings& s, bool on) { s.plots.follow_surface = on; });
    const int last = static_cast<int>(models_.size());
    grid->addWidget(follow, last, 0);
    grid->addLayout(make_buttons(), last, 1, 1, 2);
    return grid;
}

void PlotControls::add_model(QGridLayout& grid, int row, const BsdfModel& model) {
    const QString label = QString::fromStdString(model.label.empty() ? model.name : model.label);
    QString note = QString::fromStdString(model.doc);
    note = note.left(1).toUpper() + note.mid(1);
    auto* shown = make_button<QCheckBox>(label, note);
    shown->setObjectName("show-" + QString::fromStdString(model.name));
    bindings_.bind(
        shown, label,
        [name = model.name](const StudioSettings& s) { return s.plots.overlay(name).shown; },
        [name = model.name](StudioSettings& s, bool on) { s.plots.overlays[name].shown = on; });
    grid.addWidget(shown, row, 0);
    models_.push_back({model.name, nullptr});
    if (model.with_alpha) grid.addWidget(alpha_of(model, label, note), row, 1);
    grid.addWidget(more_of(model, label), row, 2);
}

QWidget* PlotControls::alpha_of(const BsdfModel& model, const QString& label,
                                const QString& tooltip) {
    const QString step = label + " Alpha";
    auto* alpha = new SliderField(QString::fromStdString(model.name) + "-alpha", kLeastAlpha,
                                  kLargestAlpha, 3, 0.01);
    QString keys;
    for (const auto& [key, text] : model.with_alpha(0.25))
        if (key != "alpha") keys += tr("; 0.25 is %1 %2").arg(key.c_str(), text.c_str());
    alpha->setToolTip(tr("Width alpha of the distribution of slopes") + keys + "\n" + tooltip);
    bindings_.bind(
        alpha, step,
        [name = model.name](const StudioSettings& s) { return s.plots.overlay(name).alpha; },
        [name = model.name](StudioSettings& s, double value) {
            s.plots.overlays[name].alpha = value;
        });
    models_.back().alpha = alpha;
    return alpha;
}

/// A button that opens the fields of all other parameters.
QWidget* PlotControls::more_of(const BsdfModel& model, const QString& label) {
    const QString name = QString::fromStdString(model.name);
    auto* more = make_button<QToolButton>(
        tr("…"),
        tr("Further settings of %1; facets reflect as measured unless set here").arg(label));
    more->setObjectName("more-" + name);
    more->setAccessibleName(tr("Further settings of %1").arg(label));
    connect(more, &QToolButton::clicked, this, [this, more, model, name, label] {
        const auto access = [](auto& s) -> auto& {
            return s.plots.overlay_settings;
        };
        const SpecSettings widths = model.with_alpha ? model.with_alpha(1) : SpecSettings();
        auto* fields =
            new ModelForm(workbench_.document(), model_rows(access, model, widths),
                          "plot-" + name + "-", QStringLiteral(" (%1)").arg(label), this);
        fields->setWindowFlag(Qt::Popup);
        fields->setAttribute(Qt::WA_DeleteOnClose);
        fields->layout()->setContentsMargins(8, 8, 8, 8);
        fields->adjustSize();
        const QPoint corner = more->mapToGlobal(QPoint(more->width(), more->height()));
        fields->move(corner - QPoint(fields->width(), 0));
        fields->show();
    });
    return more;
}

void PlotControls::show_surface_alpha(std::optional<double> alpha) {
    surface_alpha_ = alpha;
    update_models();
}

void PlotControls::update_models() {
    const PlotView& view = workbench_.settings().plots;
    const bool follows = view.follow_surface && surface_alpha_.has_value();
    for (const Model& model : models_) {
        if (model.alpha == nullptr) continue;
        const Overlay overlay = view.overlay(model.name);
        const double alpha = follows ? *surface_alpha_ : overlay.alpha;
        model.alpha->set_range(kLeastAlpha, std::max(kLargestAlpha, alpha));
        model.alpha->set_value(alpha);
        model.alpha->setEnabled(overlay.shown && !view.follow_surface);
    }
}

}  // namespace asperity::studio
