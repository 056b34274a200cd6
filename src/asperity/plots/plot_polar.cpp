// SPDX-License-Identifier: Apache-2.0
#include "plot_polar.h"

#include <asperity/core/directions.h>

#include <QObject>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

PolarFrame::PolarFrame(const QRectF& area, PlotAxis radius, const PlotStyle& style)
    : axis_(std::move(radius)), style_(style) {
    const double line = style.line_height();
    const double above = 2.2 * line, below = 2.8 * line, beside = 2.6 * line;
    radius_ = std::max(1.0, std::min(area.width() / 2 - beside, area.height() - above - below));
    const double spare = std::max(0.0, area.height() - above - below - radius_);
    centre_ = {area.center().x(), area.top() + above + spare / 2 + radius_};
}

QPointF PolarFrame::on_circle(double theta_deg, double radius) const {
    const double theta = radians(theta_deg);
    return centre_ + radius * QPointF(std::sin(theta), -std::cos(theta));
}

QPointF PolarFrame::map(double theta_deg, double value) const {
    return on_circle(theta_deg, radius_ * std::clamp(axis_.position(value), 0.0, 1.0));
}

std::optional<double> PolarFrame::theta_at(QPointF place) const {
    const QPointF from_centre = place - centre_;
    const double distance = std::hypot(from_centre.x(), from_centre.y());
    if (from_centre.y() > 0 || distance > radius_ || distance == 0) return std::nullopt;
    return degrees(std::atan2(from_centre.x(), -from_centre.y()));
}

void PolarFrame::paint_axes(QPainter& painter) const {
    const double line = style_.line_height();
    painter.setBrush(Qt::NoBrush);
    painter.setFont(style_.small);

    // Rays every 30 degrees, finer ones every 10 at the rim
    for (int theta = -90; theta <= 90; theta += 10) {
        const bool labelled = theta % 30 == 0;
        painter.setPen(QPen(labelled ? style_.grid : style_.faint, 1));
        const double from = labelled ? 0 : radius_ - 0.3 * line;
        painter.drawLine(on_circle(theta, from), on_circle(theta, radius_));
        if (!labelled) continue;
        painter.setPen(style_.faint);
        const QPointF place = on_circle(theta, radius_ + 1.1 * line);
        painter.drawText(QRectF(place.x() - 3 * line, place.y() - line, 6 * line, 2 * line),
                         Qt::AlignCenter, number_label(theta, 30) + QStringLiteral("°"));
    }

    // Rings of equal value, labelled on both halves of the base line
    double last_label = -1e9;
    for (const PlotTick& tick : axis_.ticks(std::max(2, static_cast<int>(radius_ / (3 * line))))) {
        const double r = radius_ * axis_.position(tick.value);
        QColor colour = style_.grid;
        if (tick.label.isEmpty()) colour.setAlphaF(0.5F);
        painter.setPen(QPen(colour, 1));
        const QRectF circle(centre_.x() - r, centre_.y() - r, 2 * r, 2 * r);
        if (r > 0.5) painter.drawArc(circle, 0, 180 * 16);
        if (tick.label.isEmpty() || r - last_label < style_.width_of(tick.label)) continue;
        last_label = r;
        painter.setPen(style_.faint);
        for (const double side : {-1.0, 1.0}) {
            if (r < 0.5 && side < 0) continue;
            const QPointF place = centre_ + QPointF(side * r, 0.2 * line);
            painter.drawText(QRectF(place.x() - 4 * line, place.y(), 8 * line, 1.2 * line),
                             Qt::AlignHCenter | Qt::AlignTop, tick.label);
        }
    }

    // The surface and the rim
    painter.setPen(QPen(style_.faint, 1));
    painter.drawArc(QRectF(centre_.x() - radius_, centre_.y() - radius_, 2 * radius_, 2 * radius_),
                    0, 180 * 16);
    painter.drawLine(on_circle(-90, radius_), on_circle(90, radius_));
    painter.setPen(style_.text);
    painter.setFont(style_.font);
    painter.drawText(
        QRectF(centre_.x() - radius_, centre_.y() + 1.4 * line, 2 * radius_, 1.3 * line),
        Qt::AlignCenter, axis_.label);
}

void PolarFrame::paint_line(QPainter& painter, const PlotCurve& curve) const {
    QPolygonF line;
    for (std::size_t k = 0; k < curve.x.size(); ++k) line << map(curve.x[k], curve.y[k]);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(pen_of(style_, curve.ink, curve.look));
    painter.drawPolyline(line);
}

void PolarFrame::paint_band(QPainter& painter, const PlotCurve& curve) const {
    asperity::studio::paint_band(painter, style_, curve, 0.25F,
                                 [this](double x, double y) { return map(x, y); });
}

void PolarFrame::paint_light(QPainter& painter, double theta_deg) const {
    const double line = style_.line_height(), head = 0.75 * line;
    const QColor colour = style_.ink(PlotInk::Light);
    painter.setPen(QPen(colour, line / 8, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(on_circle(theta_deg, radius_), on_circle(theta_deg, 0.8 * head));
    const QPointF along = on_circle(theta_deg, 1) - centre_;
    const QPointF across(-along.y(), along.x());
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(QPolygonF({centre_, centre_ + head * along + 0.32 * head * across,
                                   centre_ + head * along - 0.32 * head * across}));
    painter.setBrush(Qt::NoBrush);
}

void PolarFrame::paint_direction(QPainter& painter, double theta_deg, const QPen& pen) const {
    painter.setPen(pen);
    painter.drawLine(centre_, on_circle(theta_deg, radius_));
}

PolarPlot::PolarPlot(CurveSet set, PlotAxis radius, double theta_i_deg)
    : set_(std::move(set)), axis_(std::move(radius)), theta_i_deg_(theta_i_deg) {}

std::vector<LegendEntry> PolarPlot::legend() const {
    std::vector<LegendEntry> legend = legend_of(set_);
    legend.push_back({QObject::tr("light"), PlotInk::Light, CurveLook::Line});
    legend.push_back({QObject::tr("mirror direction"), PlotInk::Mirror, CurveLook::Dashes});
    return legend;
}

PolarFrame PolarPlot::frame(const QRectF& area, const PlotStyle& style) const {
    return {below_heading(area, style, set_.title, legend()), axis_, style};
}

void PolarPlot::paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const {
    paint_heading(painter, area, style, set_.title, legend());
    const PolarFrame frame = this->frame(area, style);
    frame.paint_axes(painter);
    frame.paint_direction(painter, theta_i_deg_, pen_of(style, PlotInk::Mirror, CurveLook::Dashes));
    for (const PlotCurve& curve : set_.curves)
        if (set_.error_band && !curve.error.empty()) frame.paint_band(painter, curve);
    for (const PlotCurve& curve : set_.curves) frame.paint_line(painter, curve);
    frame.paint_light(painter, -theta_i_deg_);
}

std::optional<PlotReading> PolarPlot::reading(QPointF place, const QRectF& area,
                                              const PlotStyle& style) const {
    const PolarFrame frame = this->frame(area, style);
    const auto theta = frame.theta_at(place);
    if (set_.empty() || !theta) return std::nullopt;
    const PlotCurve& first = set_.curves.front();
    const std::size_t k = set_.nearest(*theta);
    PlotReading reading;
    reading.text = set_.reading_at(k);
    if (k < first.cells.size()) reading.cell = first.cells[k];
    reading.guide = {frame.centre(), frame.map(first.x[k], axis_.high)};
    for (const PlotCurve& curve : set_.curves)
        if (const auto y = value_at(curve, first.x[k]))
            reading.dots.push_back({frame.map(first.x[k], *y), curve.ink});
    return reading;
}

}  // namespace asperity::studio
