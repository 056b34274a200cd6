// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

#include <QGridLayout>
#include <QPushButton>
#include <QWidget>

#include <array>

namespace asperity::studio {

/// What is plotted and how; which models beside it.
class PlotControls : public QWidget {
    Q_OBJECT

  public:
    explicit PlotControls(Workbench& workbench, QWidget* parent = nullptr);

    /// Alpha of the surface that the models follow, if they do; none: there is no surface yet.
    void show_surface_alpha(std::optional<double> alpha);

  signals:
    void copy_wanted();
    void save_wanted();

  private:
    QLayout* make_choices();
    QLayout* make_models();
    QLayout* make_buttons();
    void add_model(QGridLayout& grid, int row, const QString& name, Overlay PlotView::*overlay);
    void update_models();

    struct Model {
        Overlay PlotView::*overlay;
        SliderField* alpha;
    };

    Workbench& workbench_;
    Bindings bindings_;
    std::vector<Model> models_;
    std::optional<double> surface_alpha_;
};

}  // namespace asperity::studio
