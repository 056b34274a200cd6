// SPDX-License-Identifier: Apache-2.0
#include "plot_canvas.h"

#include "qt_canvas.h"

#include <asperity/plots/plot_curves.h>

#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>

namespace asperity::studio {

PlotCanvas::PlotCanvas(QWidget* parent)
    : QWidget(parent), painted_style_(style_of(palette(), font())) {
    setObjectName("plot-canvas");
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::CrossCursor);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAccessibleName(tr("Plot"));
}

void PlotCanvas::set_plot(std::shared_ptr<const plots::Plot> plot) {
    plot_ = std::move(plot);
    painted_ = {};
    look_at(place_);
}

QSize PlotCanvas::sizeHint() const {
    return {fontMetrics().height() * 32, fontMetrics().height() * 22};
}

QSize PlotCanvas::minimumSizeHint() const {
    return {fontMetrics().height() * 14, fontMetrics().height() * 11};
}

plots::PlotStyle PlotCanvas::style_now() const {
    return style_of(palette(), font());
}

void PlotCanvas::paintEvent(QPaintEvent*) {
    const plots::PlotStyle style = style_now();
    const double ratio = devicePixelRatioF();
    const QSize wanted = size() * ratio;
    const bool same_look = style.paper == painted_style_.paper &&
                           style.text == painted_style_.text && style.font == painted_style_.font;
    if (painted_.size() != wanted || !same_look) {
        painted_ = QPixmap(wanted);
        painted_.setDevicePixelRatio(ratio);
        painted_.fill(to_qt(style.paper));
        painted_style_ = style;
        QPainter painter(&painted_);
        QtCanvas canvas(painter, font());
        if (plot_) plot_->paint(canvas, from_qt(QRectF(rect())), style);
    }
    QPainter painter(this);
    painter.drawPixmap(0, 0, painted_);
    if (!reading_) return;
    QtCanvas canvas(painter, font());
    if (reading_->guide)
        canvas.line(reading_->guide->first, reading_->guide->second, {style.faint, 1, {1, 2}});
    for (const auto& [place, ink] : reading_->dots) plots::paint_dot(canvas, style, place, ink);
}

void PlotCanvas::mouseMoveEvent(QMouseEvent* event) {
    look_at(event->position());
}

void PlotCanvas::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    look_at(event->position());
    choose();
}

void PlotCanvas::leaveEvent(QEvent*) {
    look_at(std::nullopt);
}

void PlotCanvas::keyPressEvent(QKeyEvent* event) {
    const int line = fontMetrics().height();
    const double step = event->modifiers() & Qt::ShiftModifier ? line : line / 6.0;
    QPointF place = place_.value_or(QPointF(rect().center()));
    switch (event->key()) {
        case Qt::Key_Left:
            place.rx() -= step;
            break;
        case Qt::Key_Right:
            place.rx() += step;
            break;
        case Qt::Key_Up:
            place.ry() -= step;
            break;
        case Qt::Key_Down:
            place.ry() += step;
            break;
        case Qt::Key_Return:
        case Qt::Key_Enter:
            choose();
            return;
        default:
            QWidget::keyPressEvent(event);
            return;
    }
    place.setX(std::clamp(place.x(), 0.0, width() - 1.0));
    place.setY(std::clamp(place.y(), 0.0, height() - 1.0));
    look_at(place);
}

void PlotCanvas::look_at(std::optional<QPointF> place) {
    place_ = place;
    reading_.reset();
    if (place && plot_)
        reading_ = plot_->reading(from_qt(*place), from_qt(QRectF(rect())), style_now());
    emit read(reading_ ? QString::fromStdString(reading_->text) : QString());
    update();
}

void PlotCanvas::choose() {
    if (reading_ && reading_->cell) emit cell_chosen(*reading_->cell);
}

QImage plot_image(const plots::Plot& plot, QSize size, double scale, const plots::PlotStyle& style,
                  const QFont& font) {
    QImage image(size * scale, QImage::Format_RGB32);
    image.setDevicePixelRatio(scale);
    image.fill(to_qt(style.paper));
    QPainter painter(&image);
    QtCanvas canvas(painter, font);
    plot.paint(canvas, from_qt(QRectF(QPointF(), QSizeF(size))), style);
    return image;
}

}  // namespace asperity::studio
