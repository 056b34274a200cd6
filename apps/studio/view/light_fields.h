// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

namespace asperity::studio {

/// The light of the scene "Model": its kind, and the fields of that kind.
class LightFields : public Section {
    Q_OBJECT

  public:
    explicit LightFields(Document& document, QWidget* parent = nullptr);

  private:
    void add_kind();
    QWidget* point_fields();
    QWidget* sky_fields();
    QWidget* environment_fields();
    QWidget* position_field();
    SliderField* number(const QString& name, const QString& what, double low, double high,
                        double step, double ModelView::*value);

    Document& document_;
    Bindings bindings_;
};

}  // namespace asperity::studio
