// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QWidget>

namespace asperity::studio {

class SurfaceFields;

/// The controls of the scene "Microfacets Surface" but camera, statistics and buttons: Surface
/// Settings, Texture Settings, Simulation Settings, and what is shown.
class SurfacePanel : public QWidget {
    Q_OBJECT

  public:
    explicit SurfacePanel(Workbench& workbench, QWidget* parent = nullptr);

    /// Asks for a file and makes its heights the surface.
    void open_surface_file();

  private:
    SurfaceFields* surface_;
};

}  // namespace asperity::studio
