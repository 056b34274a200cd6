// SPDX-License-Identifier: Apache-2.0
#include "menu_panel.h"

#include "model_panel.h"
#include "model_scene.h"
#include "surface_panel.h"
#include "surface_scene.h"

#include <QEvent>
#include <QFormLayout>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include <algorithm>

namespace asperity::studio {

namespace {

/// Scrolls up and down only: never narrower than the widest of its rows so far.
class ColumnScroll : public QScrollArea {
  public:
    explicit ColumnScroll(QWidget* column) {
        setWidget(column);
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setFocusPolicy(Qt::NoFocus);
    }

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (watched == widget() && event->type() == QEvent::LayoutRequest) {
            const int needed =
                widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width();
            setMinimumWidth(std::max(minimumWidth(), needed));
        }
        return QScrollArea::eventFilter(watched, event);
    }
};

/// A page: controls that can be scrolled, and buttons that always stay in sight below them.
QWidget* make_page(const char* name, const std::vector<QWidget*>& controls, QWidget* buttons) {
    auto* list = new QWidget;
    auto* column = new QVBoxLayout(list);
    column->setContentsMargins(0, 0, 6, 0);
    column->setSpacing(4);
    for (QWidget* control : controls) column->addWidget(control);
    column->addStretch(1);

    auto* page = new QWidget;
    page->setObjectName(name);
    auto* layout = new QVBoxLayout(page);
    layout->setContentsMargins(6, 6, 0, 6);
    layout->addWidget(new ColumnScroll(list), 1);
    layout->addWidget(buttons);
    return page;
}

StudioStatistics frame_statistics(Viewport& viewport) {
    StudioStatistics statistics;
    statistics.frames_per_second = viewport.painter().frames_per_second();
    statistics.milliseconds_per_frame = viewport.painter().milliseconds_per_frame();
    const Frame& frame = viewport.frame();
    statistics.samples = frame.moving ? 0 : frame.samples;
    return statistics;
}

}  // namespace

MenuPanel::MenuPanel(Workbench& workbench, SurfaceScene& surface, ModelScene& model,
                     const SceneCommands& commands, QWidget* parent)
    : QStackedWidget(parent), workbench_(workbench), bindings_(workbench.document(), this) {
    addWidget(make_surface_page(surface, model, commands));
    addWidget(make_model_page(model, commands));
    bindings_.follow([this](const StudioSettings& settings) {
        setCurrentIndex(settings.scene == SceneKind::Surface ? 0 : 1);
    });
}

template <typename View>
QWidget* MenuPanel::make_camera_row(View StudioSettings::*view) {
    auto* types = new QComboBox;
    types->setObjectName("camera-type");
    types->addItems({tr("Orbiter"), tr("First-Person"), tr("6-DoF")});
    types->setToolTip(
        tr("How mouse and keys steer the view. Orbiter: drag, wheel. First-Person: W A S D Q E, "
           "drag. 6-DoF: the same, and the right button rolls. R resets"));
    bindings_.bind(
        types, tr("Camera Type"),
        [view](const StudioSettings& s) { return static_cast<int>((s.*view).camera_type); },
        [view](StudioSettings& s, int index) {
            (s.*view).camera_type = static_cast<CameraType>(index);
        });

    auto* row = new QWidget;
    auto* form = new QFormLayout(row);
    form->setContentsMargins(8, 2, 4, 2);
    form->addRow(tr("Camera Type"), types);
    form->labelForField(types)->setMinimumWidth(label_width(fontMetrics()));
    return row;
}

QWidget* MenuPanel::make_surface_page(SurfaceScene& scene, ModelScene& model,
                                      const SceneCommands& commands) {
    surface_panel_ = new SurfacePanel(workbench_);
    QWidget* camera = make_camera_row(&StudioSettings::surface_view);
    auto* statistics = new StatisticsPanel(workbench_, [this, &scene] {
        StudioStatistics figures = frame_statistics(scene.viewport());
        if (const auto surface = workbench_.surface().surface())
            figures.geometry = geometry_of(*surface);
        figures.resolution = workbench_.settings().experiment.detector.resolution;
        figures.rays = rays_of(workbench_.drawing());
        return figures;
    });
    connect(&workbench_.surface(), &SurfaceSource::ready, statistics, &StatisticsPanel::refresh);

    auto* buttons = new SurfaceButtons(workbench_, commands);
    connect(&model, &ModelScene::model_ready, buttons,
            [buttons, &model] { buttons->show_view_model(model.has_model()); });
    bindings_.follow([buttons, &model](const StudioSettings&) {
        buttons->show_view_model(model.has_model());  // a new session has none
    });
    return make_page("surface-page", {surface_panel_, camera, statistics}, buttons);
}

QWidget* MenuPanel::make_model_page(ModelScene& scene, const SceneCommands& commands) {
    QWidget* camera = make_camera_row(&StudioSettings::model_view);
    auto* statistics = new StatisticsPanel(workbench_, [this, &scene] {
        StudioStatistics figures = frame_statistics(scene.viewport());
        const ModelStatistics model = scene.statistics();
        figures.geometry = {
            model.meshes,          model.instances,           model.unique_triangles,
            model.unique_vertices, model.instanced_triangles, model.instanced_vertices};
        figures.resolution = workbench_.settings().experiment.detector.resolution;
        figures.rays = rays_of(workbench_.drawing());
        return figures;
    });
    connect(&scene, &ModelScene::model_ready, statistics, &StatisticsPanel::refresh);
    return make_page("model-page", {camera, new ModelPanel(workbench_), statistics},
                     new ModelButtons(workbench_, commands));
}

}  // namespace asperity::studio
