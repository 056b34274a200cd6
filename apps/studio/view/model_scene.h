// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"
#include "viewport.h"

#include <asperity/render/mesh.h>

#include <QWidget>

namespace asperity::studio {

/// The canvas of the scene "Model": the model in light, wearing one BRDF or two with a line between
/// them that can be dragged. Takes dropped model, result and environment files.
class ModelScene : public QWidget {
    Q_OBJECT

  public:
    explicit ModelScene(Workbench& workbench, QWidget* parent = nullptr);

    Viewport& viewport() { return *viewport_; }
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

  private:
    Workbench& workbench_;
    Viewport* viewport_;
};

}  // namespace asperity::studio
