// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QWidget>

namespace asperity::studio {

/// The controls of the scene "Microfacets Surface" but camera, statistics and buttons: Surface
/// Settings, Texture Settings, Simulation Settings, and what is shown.
class SurfacePanel : public QWidget {
    Q_OBJECT

  public:
    explicit SurfacePanel(Workbench& workbench, QWidget* parent = nullptr);
};

}  // namespace asperity::studio
