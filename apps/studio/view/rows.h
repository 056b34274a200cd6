// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QFormLayout>
#include <QString>
#include <QWidget>

namespace asperity::studio {

/// Rows of label and field that fill `parent`, without a margin.
QFormLayout* new_rows(QWidget* parent);

/// A row whose label, field and parts of the field have one tooltip.
void add_row(QFormLayout& rows, const QString& label, QWidget* field, const QString& tooltip);

/// Rich text that heads what follows it.
QString heading(const QString& text);

}  // namespace asperity::studio
