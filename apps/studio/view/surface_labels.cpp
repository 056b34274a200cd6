// SPDX-License-Identifier: Apache-2.0
#include "surface_labels.h"

#include "../model/surface_frame.h"
#include "paths_overlay.h"

#include <asperity/core/directions.h>
#include <asperity/pictures/colour_map.h>
#include <asperity/tracing/launch.h>

#include <QFontMetricsF>

#include <algorithm>
#include <array>

namespace asperity::studio {

namespace {

const QColor kBox(20, 22, 26, 170);

QString number_text(double value) {
    return QString::number(value, 'g', 3);
}

QString angle_text(double angle) {
    return QString::number(degrees(angle), 'f', 1) + "°";
}

/// Mean over the channels shown. Of errors too: channels belong to the same rays, so their errors
/// go together.
template <class OfChannel>
double shown(const Measurement& measurement, int channel, const OfChannel& of_channel) {
    if (channel >= 0) return of_channel(channel);
    double sum = 0;
    for (int c = 0; c < measurement.channels(); ++c) sum += of_channel(c);
    return sum / std::max(1, measurement.channels());
}

}  // namespace

QString layer_text(const IlluminationSettings& light, int number, const Layers& layers,
                   int channel) {
    const std::vector<Incidence> all = incidences(light);
    const auto found = std::find_if(all.begin(), all.end(),
                                    [number](const Incidence& i) { return i.number == number; });
    QString text = QString("Layer %1 of %2").arg(number).arg(all.size());
    if (found != all.end()) text += " · incident angle " + angle_text(found->theta);
    const Layer* layer = layers.layer(number);
    if (!layer || !layers.head) return text + " · not drawn yet";
    const double albedo = io::shown_albedo(*layers.head, *layer, channel);
    const double error = shown(*layers.head, channel, [layer](int c) {
        return layer->stderr_albedo.empty() ? 0.0
                                            : layer->stderr_albedo[static_cast<std::size_t>(c)];
    });
    return text + QString(" · albedo %1 ± %2").arg(albedo, 0, 'f', 4).arg(error, 0, 'g', 2);
}

QString cell_text(const Detector& detector, int cell, const Layers& layers, int number,
                  int channel) {
    const QString direction = QString("θ %1  φ %2")
                                  .arg(angle_text(detector.theta_centre(cell / detector.columns())),
                                       angle_text(detector.phi_centre(cell % detector.columns())));
    const Layer* layer = layers.layer(number);
    if (!layer || !layers.head) return direction;
    const Measurement& head = *layers.head;
    const double f = shown(head, channel, [&](int c) { return head.brdf(*layer, c, cell); });
    const double error = layer->stderr_energy.empty() ? 0 : shown(head, channel, [&](int c) {
        return head.brdf_stderr(*layer, c, cell);
    });
    return direction +
           QString("  f = %1 ± %2 /sr").arg(number_text(f), QString::number(error, 'g', 2));
}

void paint_bubble(QPainter& painter, const QRectF& within, QPointF place, const QString& text) {
    const QFontMetricsF metrics = painter.fontMetrics();
    const double padding = 0.4 * metrics.height();
    QRectF box(place + QPointF(1.2, 1.0) * metrics.height(),
               QSizeF(metrics.horizontalAdvance(text) + 2 * padding, metrics.height() + padding));
    if (box.right() > within.right()) box.moveRight(place.x() - padding);
    if (box.bottom() > within.bottom()) box.moveBottom(place.y() - padding);
    box.moveLeft(std::max(box.left(), within.left()));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 22, 26, 215));
    painter.drawRoundedRect(box, padding, padding);
    painter.setPen(Qt::white);
    painter.drawText(box, Qt::AlignCenter, text);
}

void paint_bounce_legend(QPainter& painter, QPointF bottom_left, std::size_t most) {
    const QFontMetricsF metrics = painter.fontMetrics();
    const double line = metrics.height() * 1.1, padding = 0.5 * metrics.height();
    const std::size_t rows = std::min(most, kBounceColours - 1) + 1;
    const auto text = [](std::size_t k) -> QString {
        if (k == 0) return "light on its way in";
        if (k + 1 == kBounceColours) return QString("after %1 and more").arg(k);
        return QString("after %1 reflection%2").arg(k).arg(k > 1 ? "s" : "");
    };
    double width = 0;
    for (std::size_t k = 0; k < rows; ++k)
        width = std::max(width, metrics.horizontalAdvance(text(k)));
    QRectF box(0, 0, width + 3 * line + padding, static_cast<double>(rows) * line + padding);
    box.moveBottomLeft(bottom_left);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kBox);
    painter.drawRoundedRect(box, padding, padding);
    for (std::size_t k = 0; k < rows; ++k) {
        const double y = box.top() + 0.5 * padding + (static_cast<double>(k) + 0.5) * line;
        painter.setPen(QPen(colour_of_bounce(k), 3, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(QPointF(box.left() + padding, y),
                         QPointF(box.left() + padding + 1.4 * line, y));
        painter.setPen(Qt::white);
        painter.drawText(QRectF(box.left() + padding + 2 * line, y - 0.5 * line, width + 1, line),
                         Qt::AlignVCenter | Qt::AlignLeft, text(k));
    }
}

void paint_colour_bar(QPainter& painter, const QRectF& within, const io::ValueScale& scale,
                      io::ColourMap map) {
    const QFontMetricsF metrics = painter.fontMetrics();
    const double em = metrics.height();
    const QString high = (scale.clipped ? "≥ " : "") + number_text(scale.high) + " /sr";
    const QString low = number_text(scale.low);
    const double text = std::max(metrics.horizontalAdvance(high), metrics.horizontalAdvance(low));
    const double bar = 0.7 * em, height = 7 * em, padding = 0.5 * em;
    QRectF box(0, 0, bar + text + 3 * padding, height + 2 * padding);
    box.moveBottomRight(within.bottomRight() - QPointF(0.6, 0.6) * em);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kBox);
    painter.drawRoundedRect(box, padding, padding);
    const QRectF area(box.left() + padding, box.top() + padding, bar, height);
    QLinearGradient gradient(area.bottomLeft(), area.topLeft());
    constexpr int kStops = 16;
    for (int k = 0; k <= kStops; ++k) {
        const double t = static_cast<double>(k) / kStops;
        const io::Colour c = io::colour_of(map, t);
        gradient.setColorAt(t, QColor::fromRgbF(static_cast<float>(c.r), static_cast<float>(c.g),
                                                static_cast<float>(c.b)));
    }
    painter.fillRect(area, gradient);
    painter.setPen(Qt::white);
    const QRectF beside(area.right() + padding, area.top(), text + 1, area.height());
    painter.drawText(beside, Qt::AlignTop | Qt::AlignLeft, high);
    painter.drawText(beside, Qt::AlignBottom | Qt::AlignLeft, low);
}

void paint_axis_cross(QPainter& painter, QPointF middle, const Camera& camera) {
    const double reach = 1.7 * painter.fontMetrics().height();
    struct Axis {
        Vec3 direction;
        QColor colour;
        const char* name;
    };
    std::array<Axis, 3> axes = {Axis{{1, 0, 0}, QColor(255, 110, 100), "x"},
                                Axis{{0, 1, 0}, QColor(120, 160, 255), "y"},
                                Axis{{0, 0, 1}, QColor(120, 230, 130), "z"}};
    const auto depth = [&](const Axis& axis) {
        return dot(SurfaceFrame::direction_to_world(axis.direction), camera.forward);
    };
    // Those that point to the viewer last, over the others.
    std::sort(axes.begin(), axes.end(),
              [&](const Axis& a, const Axis& b) { return depth(a) > depth(b); });
    for (const Axis& axis : axes) {
        const Vec3 d = SurfaceFrame::direction_to_world(axis.direction);
        const QPointF way(dot(d, camera.right()), -dot(d, camera.up));
        painter.setPen(QPen(axis.colour, 2, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(middle, middle + reach * way);
        QRectF box(0, 0, reach, reach);
        box.moveCenter(middle + (reach + 0.45 * painter.fontMetrics().height()) * way);
        painter.drawText(box, Qt::AlignCenter, axis.name);
    }
}

}  // namespace asperity::studio
