// SPDX-License-Identifier: Apache-2.0
#include "rows.h"

#include "section.h"

namespace asperity::studio {

QFormLayout* new_rows(QWidget* parent) {
    auto* rows = new QFormLayout(parent);
    rows->setContentsMargins(0, 0, 0, 0);
    return rows;
}

void add_row(QFormLayout& rows, const QString& label, QWidget* field, const QString& tooltip) {
    rows.addRow(label, field);
    rows.labelForField(field)->setToolTip(tooltip);
    rows.labelForField(field)->setMinimumWidth(label_width(field->fontMetrics()));
    field->setToolTip(tooltip);
    for (QWidget* part : field->findChildren<QWidget*>()) part->setToolTip(tooltip);
}

QString heading(const QString& text) {
    return QString("<p style='margin-top:8px; margin-bottom:2px'><b>%1</b></p>")
        .arg(text.toHtmlEscaped());
}

}  // namespace asperity::studio
