// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/model_stage.h"
#include "../model/workbench.h"
#include "viewport.h"

#include <asperity/render/mesh.h>

#include <QWidget>

#include <memory>

namespace asperity::studio {

class SplitHandle;

/// The canvas of the scene "Model": the model in light, wearing one BRDF or two with a line between
/// them that can be dragged. Takes dropped model, result and environment files.
class ModelScene : public QWidget {
    Q_OBJECT

  public:
    explicit ModelScene(Workbench& workbench, QWidget* parent = nullptr);

    Viewport& viewport() { return *viewport_; }
    ModelStage& stage() { return *stage_; }
    /// The picture is one of what the settings say, at full resolution.
    bool is_settled() const;
    bool has_model() const;  ///< loaded and ready; View Model appears then
    /// Of the model; zeros without one.
    ModelStatistics statistics() const;

    /// "Load Model": a dialog; `load` does it without one. Errors come as Workbench::complaint.
    void load_with_dialog();
    void load(const QString& name_or_file);
    /// Save picture: PNG as shown, EXR in linear light. Throws Error.
    void save_picture(const QString& path);

  signals:
    void model_ready();

  protected:
    void showEvent(QShowEvent*) override;
    void hideEvent(QHideEvent*) override;
    void dragEnterEvent(QDragEnterEvent*) override;
    void dropEvent(QDropEvent*) override;

  private:
    void see(bool moving);
    Viewport::Picture picture() const;
    void show_split();
    void paint_over(QPainter& painter) const;
    void take_file(const QString& path);
    void wear_file(const QString& path);
    QSize full_size() const;
    void wait_for_picture();

    Workbench& workbench_;
    ModelStage* stage_;
    Viewport* viewport_;
    SplitHandle* handle_;
    std::shared_ptr<Negative> negative_;
    bool seen_ = false;  ///< the viewport shows the model
};

}  // namespace asperity::studio
