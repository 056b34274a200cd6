// SPDX-License-Identifier: Apache-2.0
#include "plot_frame.h"

#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

double widest_label(const std::vector<PlotTick>& ticks, const PlotStyle& style) {
    double width = 0;
    for (const PlotTick& tick : ticks) width = std::max(width, style.width_of(tick.label));
    return width;
}

/// Bars on a place, for errors.
void paint_bar(QPainter& painter, QPointF top, QPointF bottom, double half_width) {
    painter.drawLine(top, bottom);
    for (const QPointF end : {top, bottom})
        painter.drawLine(end - QPointF(half_width, 0), end + QPointF(half_width, 0));
}

}  // namespace

PlotFrame::PlotFrame(const QRectF& area, PlotAxis x, PlotAxis y, const PlotStyle& style)
    : x_(std::move(x)), y_(std::move(y)), style_(style) {
    const double line = style.line_height();
    const double height = std::max(1.0, area.height() - 3.4 * line);
    y_ticks_ = y_.ticks(std::max(2, static_cast<int>(height / (2.5 * line))));
    const double left = widest_label(y_ticks_, style) + 2.1 * line;
    const double width = std::max(1.0, area.width() - left - line);
    x_ticks_ = x_.ticks(std::max(2, static_cast<int>(width / (4 * line))));
    inside_ = QRectF(area.left() + left, area.top() + 0.5 * line, width, height);
}

double PlotFrame::y_place(double y) const {
    return inside_.bottom() - y_.position(y) * inside_.height();
}

double PlotFrame::clamped(double place) const {
    return std::clamp(place, inside_.top(), inside_.bottom());
}

QPointF PlotFrame::map(double x, double y) const {
    return {inside_.left() + x_.position(x) * inside_.width(), y_place(y)};
}

double PlotFrame::x_at(double place) const {
    return x_.value_at((place - inside_.left()) / inside_.width());
}

void PlotFrame::paint_axes(QPainter& painter) const {
    const double line = style_.line_height();
    painter.setFont(style_.small);
    for (const PlotTick& tick : x_ticks_) {
        const double x = map(tick.value, y_.low).x();
        painter.setPen(QPen(style_.grid, 1));
        painter.drawLine(QPointF(x, inside_.top()), QPointF(x, inside_.bottom()));
        painter.setPen(style_.faint);
        painter.drawText(QRectF(x - 3 * line, inside_.bottom() + 0.2 * line, 6 * line, 1.2 * line),
                         Qt::AlignHCenter | Qt::AlignTop, tick.label);
    }
    for (const PlotTick& tick : y_ticks_) {
        const double y = y_place(tick.value);
        QColor colour = style_.grid;
        if (tick.label.isEmpty()) colour.setAlphaF(0.5F);
        painter.setPen(QPen(colour, 1));
        painter.drawLine(QPointF(inside_.left(), y), QPointF(inside_.right(), y));
        painter.setPen(style_.faint);
        painter.drawText(QRectF(inside_.left() - 8.4 * line, y - line, 8 * line, 2 * line),
                         Qt::AlignRight | Qt::AlignVCenter, tick.label);
    }
    painter.setPen(QPen(style_.faint, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(inside_);

    // Names of the axes
    painter.setPen(style_.text);
    painter.setFont(style_.font);
    painter.drawText(
        QRectF(inside_.left(), inside_.bottom() + 1.5 * line, inside_.width(), 1.3 * line),
        Qt::AlignCenter, x_.label);
    painter.save();
    painter.translate(inside_.left() - widest_label(y_ticks_, style_) - 1.3 * line,
                      inside_.center().y());
    painter.rotate(-90);
    painter.drawText(QRectF(-10 * line, -line, 20 * line, 2 * line), Qt::AlignCenter, y_.label);
    painter.restore();
}

void PlotFrame::paint_line(QPainter& painter, const PlotCurve& curve) const {
    QPainterPath path;
    for (std::size_t k = 1; k < curve.x.size(); ++k) {
        if (std::isnan(curve.y[k - 1]) || std::isnan(curve.y[k])) continue;
        // What lies at minus infinity of a log axis is drawn from one height below it
        const double lowest = inside_.bottom() + inside_.height();
        QPointF a = map(curve.x[k - 1], curve.y[k - 1]), b = map(curve.x[k], curve.y[k]);
        a.setY(std::min(a.y(), lowest));
        b.setY(std::min(b.y(), lowest));
        // Cut the stroke at top and bottom
        const auto at = [a, b](double y) { return a + (y - a.y()) / (b.y() - a.y()) * (b - a); };
        const double top = inside_.top(), bottom = inside_.bottom();
        if (std::max(a.y(), b.y()) < top || std::min(a.y(), b.y()) > bottom) continue;
        if (b.x() > inside_.right() + 0.5) break;
        const auto inside = [&](QPointF end) {
            return end.y() < top ? at(top) : end.y() > bottom ? at(bottom) : end;
        };
        const QPointF from = inside(a), to = inside(b);
        if (path.isEmpty() || path.currentPosition() != from) path.moveTo(from);
        path.lineTo(to);
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(pen_of(style_, curve.ink, curve.look));
    painter.drawPath(path);
}

void PlotFrame::paint_band(QPainter& painter, const PlotCurve& curve) const {
    asperity::studio::paint_band(painter, style_, curve, 0.22F, [this](double x, double y) {
        const QPointF place = map(x, y);
        return QPointF(place.x(), clamped(place.y()));
    });
}

void PlotFrame::paint_marks(QPainter& painter, const PlotCurve& curve, bool errors) const {
    const double half_width = 0.25 * style_.line_height();
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const QPointF place = map(curve.x[k], curve.y[k]);
        if (errors && k < curve.error.size() && std::isfinite(curve.error[k])) {
            const double low = y_place(curve.y[k] - curve.error[k]);
            const double high = y_place(curve.y[k] + curve.error[k]);
            painter.setPen(QPen(style_.ink(curve.ink), style_.line_height() / 14));
            if (high < inside_.bottom())
                paint_bar(painter, {place.x(), clamped(high)}, {place.x(), clamped(low)},
                          half_width);
        }
        if (place.y() >= inside_.top() - 1 && place.y() <= inside_.bottom() + 1)
            paint_dot(painter, style_, place, curve.ink);
    }
}

void PlotFrame::paint_upright(QPainter& painter, double x, const QPen& pen) const {
    painter.setPen(pen);
    const double place = map(x, y_.high).x();
    painter.drawLine(QPointF(place, inside_.top()), QPointF(place, inside_.bottom()));
}

CurvePlot::CurvePlot(CurveSet set, PlotAxis x, PlotAxis y, std::vector<Upright> uprights)
    : set_(std::move(set)), x_(std::move(x)), y_(std::move(y)), uprights_(std::move(uprights)) {}

std::vector<LegendEntry> CurvePlot::legend() const {
    std::vector<LegendEntry> legend = legend_of(set_);
    for (const Upright& upright : uprights_)
        legend.push_back({upright.name, upright.ink, CurveLook::Dashes});
    return legend;
}

PlotFrame CurvePlot::frame(const QRectF& area, const PlotStyle& style) const {
    return {below_heading(area, style, set_.title, legend()), x_, y_, style};
}

void CurvePlot::paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const {
    paint_heading(painter, area, style, set_.title, legend());
    const PlotFrame frame = this->frame(area, style);
    frame.paint_axes(painter);
    for (const Upright& upright : uprights_)
        frame.paint_upright(painter, upright.x, pen_of(style, upright.ink, CurveLook::Dashes));
    for (const PlotCurve& curve : set_.curves)
        if (set_.error_band && curve.look == CurveLook::Line && !curve.error.empty())
            frame.paint_band(painter, curve);
    for (const PlotCurve& curve : set_.curves) frame.paint_line(painter, curve);
    for (const PlotCurve& curve : set_.curves)
        if (curve.look == CurveLook::Marks) frame.paint_marks(painter, curve, set_.error_band);
}

std::optional<PlotReading> CurvePlot::reading(QPointF place, const QRectF& area,
                                              const PlotStyle& style) const {
    const PlotFrame frame = this->frame(area, style);
    if (set_.empty() || !frame.inside().contains(place)) return std::nullopt;
    const PlotCurve& first = set_.curves.front();
    const std::size_t k = set_.nearest(frame.x_at(place.x()));
    PlotReading reading;
    reading.text = set_.reading_at(k);
    if (k < first.cells.size()) reading.cell = first.cells[k];
    const double x = frame.map(first.x[k], 0).x();
    reading.guide = {x, frame.inside().top(), x, frame.inside().bottom()};
    for (const PlotCurve& curve : set_.curves)
        if (const auto y = value_at(curve, first.x[k])) {
            const QPointF dot = frame.map(first.x[k], *y);
            if (dot.y() >= frame.inside().top() && dot.y() <= frame.inside().bottom())
                reading.dots.push_back({dot, curve.ink});
        }
    return reading;
}

}  // namespace asperity::studio
