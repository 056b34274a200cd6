// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

namespace asperity::studio {

/// "Display": what of surface, dome, beam and light is shown, and in which colours.
class DisplayFields : public Section {
    Q_OBJECT

  public:
    explicit DisplayFields(Workbench& workbench, QWidget* parent = nullptr);

  private:
    void add_surface();
    void add_light();
    void add_colours();

    Bindings bindings_;
};

}  // namespace asperity::studio
