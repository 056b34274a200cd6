// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

#include <functional>

namespace asperity::studio {

/// What the buttons of both scenes do beyond the workbench's own work.
struct SceneCommands {
    std::function<void()> load_model, view_model, view_surface, run_test;
};

/// The buttons of the surface scene (thesis figure 2.2b), how far a drawing has come, and whether
/// the layers still belong to the settings.
class SurfaceButtons : public QWidget {
    Q_OBJECT

  public:
    SurfaceButtons(Workbench& workbench, const SceneCommands& commands, QWidget* parent = nullptr);

    /// View Model appears once there is a model.
    void show_view_model(bool there) { view_model_->setVisible(there); }

  private:
    void add_buttons(const SceneCommands& commands);
    void update_state();
    void update_progress();

    Workbench& workbench_;
    QPushButton *draw_, *stop_, *pause_, *clear_, *view_model_;
    QProgressBar* progress_;
    QLabel* hint_;
};

/// Those of the model scene (thesis figure 2.14).
class ModelButtons : public QWidget {
    Q_OBJECT

  public:
    ModelButtons(Workbench& workbench, const SceneCommands& commands, QWidget* parent = nullptr);
};

/// Pause or Resume, whichever the drawing needs.
void pause_or_resume(Drawing& drawing);

/// "1 min 5 s": how long something will take.
QString duration_text(double seconds);

}  // namespace asperity::studio
