// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

#include <asperity/bsdf/bsdf_models.h>

#include <QGridLayout>
#include <QPushButton>
#include <QWidget>

#include <optional>
#include <string>
#include <vector>

namespace asperity::studio {

/// What is plotted and how; which models beside it: those of bsdf_models() when it is made.
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
    void add_model(QGridLayout& grid, int row, const BsdfModel& model);
    QWidget* alpha_of(const BsdfModel& model, const QString& label, const QString& tooltip);
    QWidget* more_of(const BsdfModel& model, const QString& label);
    void update_models();

    struct Model {
        std::string name;
        SliderField* alpha;  ///< null: it has no such width
    };

    Workbench& workbench_;
    Bindings bindings_;
    std::vector<Model> models_;
    std::optional<double> surface_alpha_;
};

}  // namespace asperity::studio
