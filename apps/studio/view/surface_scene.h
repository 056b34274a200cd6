// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"
#include "viewport.h"

#include <QWidget>

#include <optional>

namespace asperity::studio {

/// The canvas of the scene "Microfacets Surface": the surface within the dome of the current layer,
/// the incident beam, paths of light. A click into the dome selects the cell.
class SurfaceScene : public QWidget {
    Q_OBJECT

  public:
    explicit SurfaceScene(Workbench& workbench, QWidget* parent = nullptr);

    Viewport& viewport() { return *viewport_; }
    /// The detector's cell seen at a place of the viewport; none off the dome.
    std::optional<int> cell_at(QPointF place) const;

  private:
    Workbench& workbench_;
    Viewport* viewport_;
};

}  // namespace asperity::studio
