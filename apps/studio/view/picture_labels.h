// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPainter>
#include <QString>

namespace asperity::studio {

/// Text in a rounded box, readable on any picture. `corner` says which corner or edge of `within`
/// it keeps to; a text too long for it ends in dots.
void paint_label(QPainter& painter, const QRectF& within, Qt::Alignment corner,
                 const QString& text);

}  // namespace asperity::studio
