// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

namespace asperity::studio {

/// "Texture Settings": how finely the sky-maps are divided.
class TextureFields : public Section {
    Q_OBJECT

  public:
    explicit TextureFields(Workbench& workbench, QWidget* parent = nullptr);

  private:
    Bindings bindings_;
    DrawingLock lock_;
};

/// "Simulation Settings": rays, bounces, what the facets are made of, which layer is looked at.
class SimulationFields : public Section {
    Q_OBJECT

  public:
    explicit SimulationFields(Workbench& workbench, QWidget* parent = nullptr);

  private:
    void add_rays();
    /// The row of a setting of the experiment.
    void add_setting(const char* name);
    void add_layer();
    void add_facets();

    Workbench& workbench_;
    Bindings bindings_;
    DrawingLock lock_;
};

}  // namespace asperity::studio
