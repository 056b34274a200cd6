// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "control_buttons.h"
#include "statistics_panel.h"

#include <QStackedWidget>

namespace asperity::studio {

class ModelScene;
class SurfacePanel;
class SurfaceScene;

/// The thesis' "Menu" (figures 2.2b and 2.14): the controls of the scene that is shown.
class MenuPanel : public QStackedWidget {
    Q_OBJECT

  public:
    MenuPanel(Workbench& workbench, SurfaceScene& surface, ModelScene& model,
              const SceneCommands& commands, QWidget* parent = nullptr);

    SurfacePanel& surface_panel() { return *surface_panel_; }

  private:
    QWidget* make_surface_page(SurfaceScene& scene, ModelScene& model,
                               const SceneCommands& commands);
    QWidget* make_model_page(ModelScene& scene, const SceneCommands& commands);
    /// The Camera Type of one scene, in a row of its own.
    template <typename View>
    QWidget* make_camera_row(View StudioSettings::*view);

    Workbench& workbench_;
    Bindings bindings_;
    SurfacePanel* surface_panel_ = nullptr;
};

}  // namespace asperity::studio
