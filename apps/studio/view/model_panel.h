// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"
#include "bindings.h"
#include "section.h"

#include <QWidget>

namespace asperity::studio {

/// The controls of the scene "Model" but camera, statistics and buttons: BRDF Settings (BRDF Type
/// and the fields of the chosen type), compare, light, look.
class ModelPanel : public QWidget {
    Q_OBJECT

  public:
    explicit ModelPanel(Workbench& workbench, QWidget* parent = nullptr);

  private:
    Section* brdf_section();
    Section* compare_section();

    Document& document_;
    Bindings bindings_;
};

}  // namespace asperity::studio
