// SPDX-License-Identifier: Apache-2.0
#include "split_handle.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

constexpr double kStep = 0.01, kLongStep = 0.1;

const QColor kLine(255, 255, 255, 230), kShade(0, 0, 0, 110);

}  // namespace

SplitHandle::SplitHandle(QWidget* view) : QWidget(view) {
    setObjectName("split-handle");
    setAccessibleName(tr("Line between the two BRDFs"));
    setToolTip(tr("Drag the line between the two BRDFs, or move it with the arrow keys"));
    setCursor(Qt::SplitHCursor);
    setFocusPolicy(Qt::StrongFocus);
    view->installEventFilter(this);
    place();
}

void SplitHandle::set_position(double position) {
    position_ = std::clamp(position, 0.0, 1.0);
    place();
}

void SplitHandle::place() {
    const int width = 2 * fontMetrics().height();
    const double line = position_ * parentWidget()->width();
    setGeometry(static_cast<int>(std::lround(line)) - width / 2, 0, width,
                parentWidget()->height());
}

void SplitHandle::move_to(double position) {
    const double before = position_;
    set_position(position);
    if (position_ != before) emit moved(position_);
}

bool SplitHandle::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize) place();
    return QWidget::eventFilter(watched, event);
}

void SplitHandle::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    grip_ = mapToParent(event->position()).x() - position_ * parentWidget()->width();
}

void SplitHandle::mouseMoveEvent(QMouseEvent* event) {
    if (!event->buttons().testFlag(Qt::LeftButton)) return;
    move_to((mapToParent(event->position()).x() - grip_) / std::max(1, parentWidget()->width()));
}

void SplitHandle::keyPressEvent(QKeyEvent* event) {
    const double step = event->modifiers().testFlag(Qt::ShiftModifier) ? kLongStep : kStep;
    switch (event->key()) {
        case Qt::Key_Left:
            return move_to(position_ - step);
        case Qt::Key_Right:
            return move_to(position_ + step);
        case Qt::Key_Home:
            return move_to(0);
        case Qt::Key_End:
            return move_to(1);
        default:
            QWidget::keyPressEvent(event);
    }
}

void SplitHandle::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double x = position_ * parentWidget()->width() - this->x();
    const QPointF middle(x, 0.5 * height());
    const double radius = 0.75 * fontMetrics().height();

    // The line, readable on bright and dark pictures
    painter.setPen(QPen(kShade, 4));
    painter.drawLine(QPointF(x, 0), QPointF(x, height()));
    painter.setPen(QPen(kLine, 2));
    painter.drawLine(QPointF(x, 0), QPointF(x, height()));

    // The knob with an arrow to each side
    painter.setPen(QPen(hasFocus() ? palette().color(QPalette::Highlight) : kShade, 2));
    painter.setBrush(kLine);
    painter.drawEllipse(middle, radius, radius);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(60, 60, 60));
    for (const double side : {-1.0, 1.0}) {
        QPainterPath arrow(middle + QPointF(side * 0.72 * radius, 0));
        arrow.lineTo(middle + QPointF(side * 0.25 * radius, -0.38 * radius));
        arrow.lineTo(middle + QPointF(side * 0.25 * radius, 0.38 * radius));
        painter.drawPath(arrow);
    }
}

}  // namespace asperity::studio
