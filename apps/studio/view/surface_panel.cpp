// SPDX-License-Identifier: Apache-2.0
#include "surface_panel.h"

#include "display_fields.h"
#include "simulation_fields.h"
#include "surface_fields.h"

#include <QVBoxLayout>

namespace asperity::studio {

SurfacePanel::SurfacePanel(Workbench& workbench, QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    surface_ = new SurfaceFields(workbench);
    layout->addWidget(surface_);
    layout->addWidget(new TextureFields(workbench));
    layout->addWidget(new SimulationFields(workbench));
    auto* display = new DisplayFields(workbench);
    display->set_open(false);
    layout->addWidget(display);
}

void SurfacePanel::open_surface_file() {
    surface_->open_file();
}

}  // namespace asperity::studio
