// SPDX-License-Identifier: Apache-2.0
#include "picture_labels.h"

#include <QStyle>

namespace asperity::studio {

void paint_label(QPainter& painter, const QRectF& within, Qt::Alignment corner,
                 const QString& text) {
    const QFontMetricsF metrics = painter.fontMetrics();
    const double margin = 0.6 * metrics.height(), padding = 0.45 * metrics.height();
    const double room = within.width() - 2 * (margin + padding);
    if (room < 2 * metrics.height()) return;
    const QString shown = metrics.elidedText(text, Qt::ElideRight, room);
    const QSizeF size(metrics.horizontalAdvance(shown) + 2 * padding, metrics.height() + padding);
    const QRectF space = within.adjusted(margin, margin, -margin, -margin);
    const QRectF box =
        QStyle::alignedRect(Qt::LeftToRight, corner, size.toSize(), space.toRect()).toRectF();
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 22, 26, 170));
    painter.drawRoundedRect(box, padding, padding);
    painter.setPen(Qt::white);
    painter.drawText(box, Qt::AlignCenter, shown);
}

}  // namespace asperity::studio
