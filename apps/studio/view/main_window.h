// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QMainWindow>

namespace asperity::studio {

class ModelScene;
class PlotsPanel;
class SurfaceScene;

/// The window of the studio: both scenes, their panels, menus, plots and log.
class MainWindow : public QMainWindow {
    Q_OBJECT

  public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    Workbench& workbench();
    SurfaceScene& surface_scene();
    ModelScene& model_scene();
    PlotsPanel& plots();

  protected:
    void closeEvent(QCloseEvent*) override;
    void dragEnterEvent(QDragEnterEvent*) override;
    void dropEvent(QDropEvent*) override;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace asperity::studio
