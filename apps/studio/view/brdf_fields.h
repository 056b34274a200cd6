// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "colour_field.h"

#include <QFormLayout>
#include <QPointer>
#include <QWidget>

#include <string>
#include <vector>

namespace asperity::studio {

/// BRDF Type and the fields of the chosen type (thesis 2.3.1), for one of a ModelView's BRDFs: each
/// analytic model of bsdf_models() when it is made, and Simulated.
class BrdfFields : public QWidget {
    Q_OBJECT

  public:
    using Which = BrdfSettings ModelView::*;

    /// `prefix` comes before the names of all controls; `side` behind those of the steps.
    BrdfFields(Document& document, Bindings& bindings, Which which, const QString& prefix,
               const QString& side, QWidget* parent = nullptr);

  private:
    void add_type(QFormLayout& form);
    void show_model(const std::string& name);
    QWidget* simulated_fields();
    QWidget* result();
    QWidget* factor();
    QWidget* colour(const QString& name, const QString& what, Rgb BrdfSettings::*value);

    Document& document_;
    Bindings& bindings_;
    Which which_;
    QString prefix_, side_;
    std::vector<std::string> models_;  ///< in the order of the list
    std::string shown_model_;
    QWidget* place_;            ///< of the fields of a model
    QPointer<QWidget> fields_;  ///< of `shown_model_`
};

}  // namespace asperity::studio
