// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/surface_painting.h"
#include "../model/workbench.h"
#include "model_lobes.h"
#include "viewport.h"

#include <QTimer>
#include <QWidget>

#include <memory>
#include <optional>

namespace asperity::studio {

/// The canvas of the scene "Microfacets Surface": the surface within the dome of the current layer,
/// the incident beam, paths of light. A click into the dome selects the cell; a second click, one
/// off the dome or Esc gives it up.
class SurfaceScene : public QWidget {
    Q_OBJECT

  public:
    explicit SurfaceScene(Workbench& workbench, QWidget* parent = nullptr);

    Viewport& viewport() { return *viewport_; }
    /// The detector's cell seen at a place of the viewport; none off the dome.
    std::optional<int> cell_at(QPointF place) const;
    /// What is said of that cell: direction, f and its error if its layer is drawn. Empty off the
    /// dome.
    QString reading_at(QPointF place) const;

  protected:
    void keyPressEvent(QKeyEvent*) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void connect_workbench();
    void connect_viewport();
    void follow_settings(const StudioSettings& before);
    void take_surface();
    void take_layer();
    void take_paths();
    void show_picture();
    void click(QPointF place, Qt::MouseButton button);
    void hover(QPointF place);

    const SurfaceBody* body() const { return body_ ? body_->if_made() : nullptr; }
    void paint_kept_lines(QPainter& painter);
    void forget_lines();
    void paint_lines(QPainter& painter) const;
    void paint_labels(QPainter& painter) const;

    Workbench& workbench_;
    Viewport* viewport_;
    std::shared_ptr<const Lazy<SurfaceBody>> body_;
    std::shared_ptr<const Lazy<DomePicture>> dome_;
    std::shared_ptr<const Lazy<Lobe>> lobe_;
    std::vector<ModelLobe> model_lobes_;
    std::shared_ptr<const FacetSet> selected_facets_;
    Detector detector_;
    std::optional<QPointF> hovered_;
    QImage lines_;  ///< of the still view seen by lines_camera_, over lines_body_; null: outdated
    Camera lines_camera_;
    const SurfaceBody* lines_body_ = nullptr;
    QTimer growing_;  ///< a layer grows: it is shown about ten times a second
};

}  // namespace asperity::studio
