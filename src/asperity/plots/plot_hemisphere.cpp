// SPDX-License-Identifier: Apache-2.0
#include "plot_hemisphere.h"

#include "plot_curves.h"

#include <asperity/core/directions.h>

#include <QObject>
#include <QPaintEngine>
#include <QPolygonF>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

QColor colour(io::Colour c) {
    return QColor::fromRgbF(static_cast<float>(c.r), static_cast<float>(c.g),
                            static_cast<float>(c.b));
}

/// A line that is seen on any colour: light on a dark rim.
template <class Paint>
void paint_outlined(QPainter& painter, double width, const Paint& paint) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Qt::black, 2.2 * width));
    paint();
    painter.setPen(QPen(Qt::white, width));
    paint();
}

/// Directions are told in degrees.
QString direction_text(double theta, double phi) {
    return QStringLiteral("θₒ = %1°   φₒ = %2°")
        .arg(degrees(theta), 0, 'f', 1)
        .arg(degrees(phi), 0, 'f', 1);
}

}  // namespace

HemispherePlot::HemispherePlot(Data data) : data_(std::move(data)) {
    values_ = io::values_of(*data_.head, *data_.layer, data_.settings.channel);
    scale_ = io::value_scale(*data_.head, {data_.layer.get()}, data_.settings);
}

QString HemispherePlot::title() const {
    return QObject::tr("Layer %1, θᵢ = %2°")
        .arg(data_.layer->number)
        .arg(value_text(degrees(data_.layer->theta_i)));
}

QRectF HemispherePlot::disc(const QRectF& area, const PlotStyle& style) const {
    const QRectF rest = below_heading(area, style, title(), {});
    const double line = style.line_height();
    const double for_bar = 8 * line, label = 2.4 * line;
    const double side =
        std::max(2.0, std::min(rest.width() - for_bar - label, rest.height() - 1.2 * label));
    const double left = rest.left() + label + (rest.width() - for_bar - label - side) / 2;
    return {left, rest.top() + (rest.height() - side) / 2, side, side};
}

QPointF HemispherePlot::place_of(const QRectF& disc, double theta, double phi) {
    const double r = 0.5 * disc.width() * std::sin(theta);
    return disc.center() + QPointF(r * std::cos(phi), -r * std::sin(phi));
}

void HemispherePlot::paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const {
    paint_heading(painter, area, style, title(), {});
    const QRectF disc = this->disc(area, style);
    // Files that can be enlarged get a picture of their own, finer than any screen
    const bool vector = painter.paintEngine()->type() == QPaintEngine::SVG;
    const double scale = vector ? 3 : painter.device()->devicePixelRatioF();
    painter.drawImage(disc, image(static_cast<int>(std::ceil(disc.width() * scale))));
    paint_grid(painter, disc, style);
    paint_marks(painter, disc);
    if (data_.cell) paint_cell(painter, disc);
    paint_bar(painter, disc, style);
}

const QImage& HemispherePlot::image(int pixels) const {
    if (image_.width() != pixels)
        image_ = data_.painter->paint(pixels, data_.head->detector, values_, scale_,
                                      data_.settings.colour_map);
    return image_;
}

void HemispherePlot::paint_grid(QPainter& painter, const QRectF& disc,
                                const PlotStyle& style) const {
    const double line = style.line_height();
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(255, 255, 255, 60), 1));
    for (const double theta_deg : {30.0, 60.0}) {
        const double r = 0.5 * disc.width() * std::sin(radians(theta_deg));
        painter.drawEllipse(disc.center(), r, r);
    }
    painter.drawLine(place_of(disc, kPi / 2, 0), place_of(disc, kPi / 2, kPi));
    painter.drawLine(place_of(disc, kPi / 2, kPi / 2), place_of(disc, kPi / 2, -kPi / 2));
    painter.setPen(QPen(style.faint, 1));
    painter.drawEllipse(disc);
    painter.setFont(style.small);
    for (int phi = 0; phi < 360; phi += 90) {
        const double reach = 0.5 * disc.width() + (phi % 180 == 0 ? 1.2 : 0.75) * line;
        const QPointF place =
            disc.center() + reach * QPointF(std::cos(radians(phi)), -std::sin(radians(phi)));
        const QRectF box(place.x() - 3 * line, place.y() - line, 6 * line, 2 * line);
        painter.drawText(box, Qt::AlignCenter, QString::number(phi) + QStringLiteral("°"));
    }
}

void HemispherePlot::paint_marks(QPainter& painter, const QRectF& disc) const {
    const Layer& layer = *data_.layer;
    const double size = std::max(4.0, 0.018 * disc.width());
    // The mirror direction: a ring; the light: a small sun
    const QPointF mirror = place_of(disc, layer.theta_i, layer.phi_i + kPi);
    paint_outlined(painter, 1.3, [&] { painter.drawEllipse(mirror, size, size); });
    if (layer.theta_i == 0) return;
    const QPointF light = place_of(disc, layer.theta_i, layer.phi_i);
    paint_outlined(painter, 1.3, [&] {
        for (int k = 0; k < 8; ++k) {
            const QPointF along(std::cos(k * kPi / 4), std::sin(k * kPi / 4));
            painter.drawLine(light + 0.55 * size * along, light + 1.1 * size * along);
        }
    });
}

void HemispherePlot::paint_cell(QPainter& painter, const QRectF& disc) const {
    const Detector& detector = data_.head->detector;
    if (*data_.cell < 0 || *data_.cell >= detector.cells()) return;
    const int row = *data_.cell / detector.columns(), column = *data_.cell % detector.columns();
    constexpr int kSteps = 12;
    QPolygonF outline;
    const auto add = [&](double theta, int step) {
        const double share = static_cast<double>(step) / kSteps;
        outline << place_of(disc, theta,
                            detector.phi_edge(column) + share * (detector.phi_edge(column + 1) -
                                                                 detector.phi_edge(column)));
    };
    for (int step = 0; step <= kSteps; ++step) add(detector.theta_edge(row), step);
    for (int step = kSteps; step >= 0; --step) add(detector.theta_edge(row + 1), step);
    paint_outlined(painter, 1.5, [&] { painter.drawPolygon(outline); });
}

void HemispherePlot::paint_bar(QPainter& painter, const QRectF& disc,
                               const PlotStyle& style) const {
    const double line = style.line_height();
    const QRectF bar(disc.right() + 2.8 * line, disc.top() + 0.05 * disc.height(), line,
                     0.9 * disc.height());
    QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
    constexpr int kStops = 32;
    for (int k = 0; k <= kStops; ++k) {
        const double t = static_cast<double>(k) / kStops;
        gradient.setColorAt(t, colour(io::colour_of(data_.settings.colour_map, t)));
    }
    painter.setPen(QPen(style.faint, 1));
    painter.setBrush(gradient);
    painter.drawRect(bar);
    painter.setBrush(Qt::NoBrush);

    const PlotAxis axis{{}, scale_.low, scale_.high, scale_.scale == io::Scale::Log, 0};
    painter.setFont(style.small);
    for (const PlotTick& tick :
         axis.ticks(std::max(2, static_cast<int>(bar.height() / (2.5 * line))))) {
        const double y = bar.bottom() - axis.position(tick.value) * bar.height();
        const double length = tick.label.isEmpty() ? 0.15 * line : 0.3 * line;
        painter.setPen(QPen(style.faint, 1));
        painter.drawLine(QPointF(bar.right(), y), QPointF(bar.right() + length, y));
        const bool last = scale_.clipped && tick.value > scale_.high * (1 - 1e-6);
        painter.drawText(QRectF(bar.right() + 0.45 * line, y - line, 6 * line, 2 * line),
                         Qt::AlignLeft | Qt::AlignVCenter,
                         last ? QStringLiteral("≥ ") + tick.label : tick.label);
    }
    painter.setPen(style.text);
    painter.setFont(style.font);
    painter.drawText(QRectF(bar.left() - line, bar.top() - 1.9 * line, 6 * line, 1.5 * line),
                     Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("f  [sr⁻¹]"));
}

double HemispherePlot::standard_error(int cell) const {
    const Measurement& head = *data_.head;
    if (data_.layer->stderr_energy.empty()) return 0;
    if (data_.settings.channel >= 0)
        return head.brdf_stderr(*data_.layer, data_.settings.channel, cell);
    double sum = 0;  // channels share their rays
    for (int c = 0; c < head.channels(); ++c) sum += head.brdf_stderr(*data_.layer, c, cell);
    return sum / head.channels();
}

std::optional<PlotReading> HemispherePlot::reading(QPointF place, const QRectF& area,
                                                   const PlotStyle& style) const {
    const QRectF disc = this->disc(area, style);
    const double x = (place.x() - disc.center().x()) / (0.5 * disc.width());
    const double y = (disc.center().y() - place.y()) / (0.5 * disc.width());
    const double r2 = x * x + y * y;
    if (r2 >= 1) return std::nullopt;
    const Detector& detector = data_.head->detector;
    const int cell = detector.cell_of({x, y, std::sqrt(1 - r2)});
    PlotReading reading;
    reading.cell = cell;
    reading.text = QObject::tr("cell %1   %2   f = %3 ± %4 sr⁻¹")
                       .arg(cell)
                       .arg(direction_text(detector.theta_centre(cell / detector.columns()),
                                           detector.phi_centre(cell % detector.columns())),
                            value_text(values_[static_cast<std::size_t>(cell)]),
                            error_text(standard_error(cell)));
    return reading;
}

PlotTable HemispherePlot::table() const {
    const Detector& detector = data_.head->detector;
    PlotTable table{{{QStringLiteral("cell"), {}},
                     {QStringLiteral("theta_o [deg]"), {}},
                     {QStringLiteral("phi_o [deg]"), {}},
                     {QStringLiteral("f [1/sr]"), values_},
                     {QStringLiteral("standard error of f [1/sr]"), {}}}};
    for (int cell = 0; cell < detector.cells(); ++cell) {
        table.columns[0].values.push_back(cell);
        table.columns[1].values.push_back(
            degrees(detector.theta_centre(cell / detector.columns())));
        table.columns[2].values.push_back(degrees(detector.phi_centre(cell % detector.columns())));
        table.columns[4].values.push_back(standard_error(cell));
    }
    return table;
}

}  // namespace asperity::studio
