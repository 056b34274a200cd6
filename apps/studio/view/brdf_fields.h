// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "colour_field.h"

#include <QFormLayout>
#include <QWidget>

namespace asperity::studio {

/// BRDF Type and the fields of the chosen type (thesis 2.3.1), for one of a ModelView's BRDFs.
class BrdfFields : public QWidget {
    Q_OBJECT

  public:
    using Which = BrdfSettings ModelView::*;

    /// `prefix` comes before the names of all controls; `side` behind those of the steps.
    BrdfFields(Document& document, Bindings& bindings, Which which, const QString& prefix,
               const QString& side, QWidget* parent = nullptr);

  private:
    void add_type(QFormLayout& form);
    QWidget* cook_torrance_fields();
    QWidget* simulated_fields();
    QWidget* number(const QString& name, const QString& what, double high, double step,
                    double BrdfSettings::*value);
    QWidget* colour(const QString& name, const QString& what, Rgb BrdfSettings::*value);

    Document& document_;
    Bindings& bindings_;
    Which which_;
    QString prefix_, side_;
};

}  // namespace asperity::studio
