// SPDX-License-Identifier: Apache-2.0
#include "control_buttons.h"

#include "section.h"

#include <QGridLayout>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

QPushButton* make_button(const QString& label, const QString& tooltip) {
    auto* button = new QPushButton(label);
    button->setObjectName(kebab_case(label));
    button->setToolTip(tooltip);
    return button;
}

/// Keeps its place while it is hidden: nothing beside it moves.
void keep_place(QWidget* widget) {
    QSizePolicy policy = widget->sizePolicy();
    policy.setRetainSizeWhenHidden(true);
    widget->setSizePolicy(policy);
}

}  // namespace

SurfaceButtons::SurfaceButtons(Workbench& workbench, const SceneCommands& commands, QWidget* parent)
    : QWidget(parent), workbench_(workbench), progress_(new QProgressBar), hint_(new QLabel) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    add_buttons(commands);

    progress_->setObjectName("drawing-progress");
    progress_->setRange(0, 1000);
    progress_->setTextVisible(true);
    hint_->setObjectName("layers-hint");
    hint_->setWordWrap(true);
    hint_->setText(tr("The layers belong to other settings: Draw To Textures fills them anew."));
    QPalette colours = hint_->palette();
    colours.setColor(QPalette::WindowText, QColor("#d9822b"));
    hint_->setPalette(colours);
    // Never both at a time: one place for the two
    keep_place(progress_);
    keep_place(hint_);
    auto* lines = new QGridLayout;
    lines->addWidget(progress_, 0, 0);
    lines->addWidget(hint_, 0, 0);
    layout->addLayout(lines);

    Drawing& drawing = workbench.drawing();
    connect(&workbench, &Workbench::drawing_changed, this, &SurfaceButtons::update_state);
    connect(&drawing, &Drawing::layers_changed, this, &SurfaceButtons::update_state);
    connect(&drawing, &Drawing::completed, this, &SurfaceButtons::update_state);
    connect(&workbench.document(), &Document::changed, this, &SurfaceButtons::update_state);
    connect(&drawing, &Drawing::progressed, this, &SurfaceButtons::update_progress);
    update_state();
}

void SurfaceButtons::add_buttons(const SceneCommands& commands) {
    draw_ = make_button(tr("Draw To Textures"),
                        tr("Traces the light of all layers, from the last one down to layer 1"));
    stop_ = make_button(tr("Stop Drawing"), tr("Ends the drawing and clears all layers"));
    pause_ = make_button(tr("Pause/Resume"), tr("Holds the drawing; what was drawn stays"));
    clear_ = make_button(tr("Clear Textures"), tr("Empties all layers"));
    view_model_ = make_button(tr("View Model"), tr("Shows the scene with the model"));
    auto* load_model = make_button(tr("Load Model"),
                                   tr("A model from a file: .obj, .ply, .stl, .gltf, .glb, .3ds"));
    auto* run_test = make_button(tr("Run Test"), tr("Runs the 79 checks of the thesis"));
    keep_place(view_model_);
    view_model_->hide();

    auto* grid = new QGridLayout;
    grid->setSpacing(4);
    grid->addWidget(draw_, 0, 0);
    grid->addWidget(stop_, 0, 1);
    grid->addWidget(pause_, 1, 0);
    grid->addWidget(clear_, 1, 1);
    grid->addWidget(load_model, 2, 0);
    grid->addWidget(view_model_, 2, 1);
    grid->addWidget(run_test, 3, 0, 1, 2);
    static_cast<QVBoxLayout*>(layout())->addLayout(grid);

    connect(draw_, &QPushButton::clicked, &workbench_, &Workbench::draw_to_textures);
    connect(stop_, &QPushButton::clicked, &workbench_, &Workbench::stop_drawing);
    connect(pause_, &QPushButton::clicked, this, [this] { pause_or_resume(workbench_.drawing()); });
    connect(clear_, &QPushButton::clicked, &workbench_.drawing(), &Drawing::clear);
    connect(view_model_, &QPushButton::clicked, this, commands.view_model);
    connect(load_model, &QPushButton::clicked, this, commands.load_model);
    connect(run_test, &QPushButton::clicked, this, commands.run_test);
}

void SurfaceButtons::update_state() {
    const Drawing& drawing = workbench_.drawing();
    const bool drawing_now = workbench_.is_drawing();
    const bool has_layers = !drawing.layers().by_number.empty();
    draw_->setEnabled(!drawing_now);
    stop_->setEnabled(drawing_now);
    pause_->setEnabled(drawing.state() != Drawing::State::Idle);
    pause_->setText(drawing.state() == Drawing::State::Paused ? tr("Resume") : tr("Pause"));
    clear_->setEnabled(has_layers || drawing_now);
    progress_->setVisible(drawing_now);
    hint_->setVisible(has_layers && !drawing_now && !workbench_.are_layers_current());
    update_progress();
}

void SurfaceButtons::update_progress() {
    const Drawing& drawing = workbench_.drawing();
    const Progress progress = drawing.progress();
    const double share = progress.total == 0 ? 0.0
                                             : static_cast<double>(progress.done) /
                                                   static_cast<double>(progress.total);
    progress_->setValue(static_cast<int>(std::lround(1000 * std::min(share, 1.0))));

    QString text = drawing.state() == Drawing::State::Idle     ? tr("waiting for the surface")
                   : drawing.state() == Drawing::State::Paused ? tr("paused, %p %")
                   : progress.done == 0
                       ? tr("preparing")
                       : tr("%p %, %1 left").arg(duration_text(progress.seconds_left));
    progress_->setFormat(text);
}

ModelButtons::ModelButtons(Workbench& workbench, const SceneCommands& commands, QWidget* parent)
    : QWidget(parent) {
    auto* start = make_button(tr("Start BRDF"), tr("The model wears the chosen BRDF"));
    auto* stop = make_button(tr("Stop BRDF"), tr("The model is a black shape again"));
    auto* load_model = make_button(tr("Load Model"),
                                   tr("A model from a file: .obj, .ply, .stl, .gltf, .glb, .3ds"));
    auto* view_surface = make_button(tr("View Surface"), tr("Shows the microfacets surface"));

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(4);
    grid->addWidget(start, 0, 0);
    grid->addWidget(stop, 0, 1);
    grid->addWidget(load_model, 1, 0);
    grid->addWidget(view_surface, 1, 1);

    Document& document = workbench.document();
    const auto run_brdf = [&document](const QString& what, bool runs) {
        document.change(what, [runs](StudioSettings& s) { s.model_view.brdf_runs = runs; });
    };
    connect(start, &QPushButton::clicked, this, [=] { run_brdf(tr("Start BRDF"), true); });
    connect(stop, &QPushButton::clicked, this, [=] { run_brdf(tr("Stop BRDF"), false); });
    connect(load_model, &QPushButton::clicked, this, commands.load_model);
    connect(view_surface, &QPushButton::clicked, this, commands.view_surface);
    const auto update = [start, stop, &document] {
        const bool runs = document.settings().model_view.brdf_runs;
        start->setEnabled(!runs);
        stop->setEnabled(runs);
    };
    connect(&document, &Document::changed, this, update);
    update();
}

void pause_or_resume(Drawing& drawing) {
    if (drawing.state() == Drawing::State::Paused)
        drawing.resume();
    else
        drawing.pause();
}

QString duration_text(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 60) return QObject::tr("%1 s").arg(whole);
    if (whole < 3600) return QObject::tr("%1 min %2 s").arg(whole / 60).arg(whole % 60);
    return QObject::tr("%1 h %2 min").arg(whole / 3600).arg(whole / 60 % 60);
}

}  // namespace asperity::studio
