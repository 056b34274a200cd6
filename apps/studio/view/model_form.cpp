// SPDX-License-Identifier: Apache-2.0
#include "model_form.h"

#include "param_control.h"
#include "rows.h"

namespace asperity::studio {

ModelForm::ModelForm(Document& document, const ParamTable<StudioSettings>& rows,
                     const QString& prefix, const QString& side, QWidget* parent)
    : QWidget(parent), bindings_(document, this) {
    auto* form = new_rows(this);
    for (const Param<StudioSettings>& row : rows) {
        const QString name = QString::fromStdString(label(row.info));
        add_row(*form, name,
                make_control(row, name + side, bindings_, document,
                             prefix + QString::fromStdString(row.info.name)),
                tooltip_of(row));
    }
}

}  // namespace asperity::studio
