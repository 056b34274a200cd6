// SPDX-License-Identifier: Apache-2.0
#include "tour.h"

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include <array>

namespace asperity::studio {

namespace {

struct Step {
    const char* title;
    const char* text;
    void (*set)(StudioSettings&);
};

/// What all steps have in common: small enough to be drawn in a second or two.
void set_common(StudioSettings& s) {
    s.scene = SceneKind::Surface;
    s.experiment = {};
    s.experiment.surface.size = 512;
    s.experiment.detector.resolution = 64;
    s.experiment.run.jitter = 2;
    s.experiment.run.bounces = 8;
    s.surface_view.dome = s.surface_view.beam = s.surface_view.paths = true;
    s.surface_view.path_count = 60;
    s.plots.scale = io::Scale::Linear;
    s.plots.follow_surface = true;
    for (auto& [name, overlay] : s.plots.overlays) overlay.shown = false;
}

void make_gaussian(StudioSettings& s, double alpha) {
    s.experiment.surface.kind = "gaussian";
    s.experiment.surface.alpha_x = s.experiment.surface.alpha_y = alpha;
}

constexpr std::array kSteps = {
    Step{QT_TR_NOOP("A flat mirror"),
         QT_TR_NOOP("Surface Roughness is 0. Light falls in at 60° from the normal (layer 5), and "
                    "all of it leaves at 60° on the other side: one bright cell of the dome, one "
                    "needle in the plot. The angle of reflection equals the angle of incidence."),
         [](StudioSettings& s) {
             set_common(s);
             s.experiment.surface.roughness = 0;
             s.surface_view.current_layer = 5;
             s.plots.kind = PlotKind::LobePolar;
         }},
    Step{QT_TR_NOOP("A rough mirror"),
         QT_TR_NOOP("The same light on bumps with a slope of about 0.1. Every facet is still a "
                    "perfect mirror, but each is tilted its own way: the needle has become a lobe "
                    "around the mirror direction. Rougher surfaces have wider and lower lobes; the "
                    "energy is the same. Try it: change Alpha and draw again."),
         [](StudioSettings& s) {
             set_common(s);
             make_gaussian(s, 0.1);
             s.surface_view.current_layer = 5;
             s.plots.kind = PlotKind::LobePolar;
         }},
    Step{QT_TR_NOOP("Light at a grazing angle"),
         QT_TR_NOOP("Layer 2: the light comes in 78° from the normal, on bumps of 0.2. The lobe "
                    "leaves the mirror direction towards the horizon and is much brighter: facets "
                    "that face the light hide the others, and a BRDF divides by the cosine. Wet "
                    "roads shine against the sun for this reason."),
         [](StudioSettings& s) {
             set_common(s);
             make_gaussian(s, 0.2);
             s.surface_view.current_layer = 2;
             s.plots.kind = PlotKind::LobePolar;
         }},
    Step{QT_TR_NOOP("More bounces"),
         QT_TR_NOOP("Steep bumps, alpha 1: much of the light hits a second facet, or a third, "
                    "before it gets out. The plot shows how much leaves after each number of "
                    "bounces. With Ray Bounces at 1 all but the first share would be lost, and "
                    "rough metals would look too dark. Try it: set 1 and draw again."),
         [](StudioSettings& s) {
             set_common(s);
             make_gaussian(s, 1.0);
             s.experiment.run.bounces = 16;
             s.surface_view.current_layer = 12;
             s.plots.kind = PlotKind::Albedo;
         }},
    Step{
        QT_TR_NOOP("Beside Cook-Torrance"),
        QT_TR_NOOP("The formula that games and films use, drawn beside what was traced, for the "
                   "same slope. Near the normal both agree. Towards the horizon the formula is too "
                   "dark: its shadowing term (thesis eq. 3.6) takes too much of the light that "
                   "leaves low. Tick Beckmann in the plot, made for Gaussian bumps."),
        [](StudioSettings& s) {
            set_common(s);
            make_gaussian(s, 0.3);
            s.surface_view.current_layer = 8;
            s.plots.kind = PlotKind::LobeCartesian;
            s.plots.overlays["cook-torrance"].shown = true;
        }},
};

}  // namespace

Tour::Tour(Workbench& workbench, QWidget* parent)
    : QFrame(parent),
      workbench_(workbench),
      title_(new QLabel),
      text_(new QLabel),
      back_(new QPushButton(tr("Back"))),
      next_(new QPushButton(tr("Next"))) {
    setObjectName("tour");
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::AlternateBase);
    QFont bold = title_->font();
    bold.setBold(true);
    bold.setPointSizeF(1.15 * bold.pointSizeF());
    title_->setFont(bold);
    title_->setObjectName("tour-title");
    text_->setWordWrap(true);
    text_->setObjectName("tour-text");
    back_->setObjectName("tour-back");
    next_->setObjectName("tour-next");
    auto* close = new QToolButton;
    close->setObjectName("tour-close");
    close->setText("×");
    close->setAutoRaise(true);
    close->setToolTip(tr("Ends the tour; the settings stay"));

    auto* head = new QHBoxLayout;
    head->addWidget(title_, 1);
    head->addWidget(back_);
    head->addWidget(next_);
    head->addWidget(close);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(head);
    layout->addWidget(text_);

    connect(back_, &QPushButton::clicked, this, [this] { show_step(step_ - 1); });
    connect(next_, &QPushButton::clicked, this, [this] {
        if (step_ + 1 < step_count())
            show_step(step_ + 1);
        else
            hide();
    });
    connect(close, &QToolButton::clicked, this, &QWidget::hide);
    hide();
}

int Tour::step_count() {
    return static_cast<int>(kSteps.size());
}

void Tour::begin() {
    show();
    show_step(0);
}

void Tour::show_step(int step) {
    step_ = step;
    const Step& now = kSteps.at(static_cast<std::size_t>(step));
    title_->setText(tr("%1 of %2: %3").arg(step + 1).arg(step_count()).arg(tr(now.title)));
    text_->setText(tr(now.text));
    back_->setEnabled(step > 0);
    next_->setText(step + 1 < step_count() ? tr("Next") : tr("Finish"));
    set_controls();
}

void Tour::set_controls() {
    const Step& now = kSteps.at(static_cast<std::size_t>(step_));
    if (workbench_.is_drawing()) workbench_.stop_drawing();
    workbench_.document().change(tr("Tour: %1").arg(tr(now.title)), now.set);
    const bool drawn = workbench_.drawing().layers().complete && workbench_.are_layers_current();
    if (!drawn) workbench_.draw_to_textures();
}

}  // namespace asperity::studio
