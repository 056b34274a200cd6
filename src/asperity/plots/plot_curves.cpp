// SPDX-License-Identifier: Apache-2.0
#include "plot_curves.h"

#include "plot_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::studio {

namespace {

constexpr double kModelsStandOut = 4;
constexpr double kSameX = 1e-9;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct PlacedEntry {
    LegendEntry entry;
    QPointF place;  ///< left end of the sample, middle of the text
};

/// Curves that lie upon each other are both seen, and told apart without colour.
QList<qreal> dashes_of(PlotInk ink) {
    if (ink == PlotInk::Ggx) return {7, 2, 1.5, 2};
    if (ink == PlotInk::Beckmann) return {2.5, 1.5};
    return {5, 2.5};
}

double sample_width(const PlotStyle& style) {
    return 2 * style.line_height();
}

/// Entries from left to right, as many to a row as fit, below `top`.
std::vector<PlacedEntry> placed(const std::vector<LegendEntry>& legend, const QRectF& area,
                                const PlotStyle& style, double top) {
    const double height = style.line_height(), gap = height;
    std::vector<PlacedEntry> result;
    double x = area.left() + 0.5 * height, y = top + 0.6 * height;
    for (const LegendEntry& entry : legend) {
        const double width = sample_width(style) + 0.4 * height + style.width_of(entry.text);
        if (x + width > area.right() && x > area.left() + height) {
            x = area.left() + 0.5 * height;
            y += 1.15 * height;
        }
        result.push_back({entry, {x, y}});
        x += width + gap;
    }
    return result;
}

double title_height(const PlotStyle& style, const QString& title) {
    return title.isEmpty() ? 0.3 * style.line_height() : 1.6 * style.line_height();
}

void paint_entry(QPainter& painter, const PlotStyle& style, const PlacedEntry& placed) {
    const double height = style.line_height(), width = sample_width(style);
    const auto& [entry, place] = placed;
    if (entry.band) {
        QColor colour = style.ink(entry.ink);
        colour.setAlphaF(0.22F);
        painter.fillRect(QRectF(place.x(), place.y() - 0.32 * height, width, 0.64 * height),
                         colour);
    }
    painter.setPen(pen_of(style, entry.ink, entry.look));
    painter.drawLine(place, place + QPointF(width, 0));
    if (entry.look == CurveLook::Marks)
        paint_dot(painter, style, place + QPointF(width / 2, 0), entry.ink);
    painter.setPen(style.text);
    painter.setFont(style.font);
    painter.drawText(QRectF(place.x() + width + 0.4 * height, place.y() - height,
                            style.width_of(entry.text) + height, 2 * height),
                     Qt::AlignLeft | Qt::AlignVCenter, entry.text);
}

}  // namespace

double CurveSet::top() const {
    double measured = 0, modelled = 0;
    for (const PlotCurve& curve : curves) {
        double& most = curve.look == CurveLook::Dashes ? modelled : measured;
        for (const double y : curve.y)
            if (std::isfinite(y)) most = std::max(most, y);
    }
    return measured > 0 ? std::max(measured, std::min(modelled, kModelsStandOut * measured))
                        : modelled;
}

std::size_t CurveSet::nearest(double x) const {
    const std::vector<double>& xs = curves.front().x;
    const auto by_distance = [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); };
    return static_cast<std::size_t>(std::min_element(xs.begin(), xs.end(), by_distance) -
                                    xs.begin());
}

QString CurveSet::reading_at(std::size_t k) const {
    const double x = curves.front().x[k];
    QString text = QStringLiteral("%1 = %2%3").arg(x_name, value_text(x), x_unit);
    for (const PlotCurve& curve : curves) {
        const auto y = value_at(curve, x);
        if (!y) continue;
        const QString& name = curve.brief.isEmpty() ? curve.name : curve.brief;
        text += QStringLiteral("   %1: %2").arg(name, value_text(*y));
        if (k < curve.error.size()) text += QStringLiteral(" ± ") + error_text(curve.error[k]);
    }
    if (!y_unit.isEmpty()) text += QStringLiteral("   [%1]").arg(y_unit);
    return text;
}

PlotTable CurveSet::table() const {
    // Rows: every x of any curve
    std::vector<double> xs;
    for (const PlotCurve& curve : curves) xs.insert(xs.end(), curve.x.begin(), curve.x.end());
    std::sort(xs.begin(), xs.end());
    xs.erase(std::unique(xs.begin(), xs.end(),
                         [](double a, double b) { return std::abs(a - b) < kSameX; }),
             xs.end());
    const auto spread = [&](const std::vector<double>& at, const std::vector<double>& values) {
        std::vector<double> column(xs.size(), kNone);
        for (std::size_t k = 0; k < at.size(); ++k) {
            const auto row = std::lower_bound(xs.begin(), xs.end(), at[k] - kSameX);
            column[static_cast<std::size_t>(row - xs.begin())] = values[k];
        }
        return column;
    };
    PlotTable table{{{x_column, xs}}};
    for (const PlotCurve& curve : curves) {
        table.columns.push_back({curve.column, spread(curve.x, curve.y)});
        if (!curve.error.empty())
            table.columns.push_back({QStringLiteral("standard error of ") + curve.column,
                                     spread(curve.x, curve.error)});
    }
    for (const auto& [header, values] : more)
        table.columns.push_back({header, spread(curves.front().x, values)});
    return table;
}

std::optional<double> value_at(const PlotCurve& curve, double x) {
    const auto above = std::lower_bound(curve.x.begin(), curve.x.end(), x - kSameX);
    if (above == curve.x.end()) return std::nullopt;
    const std::size_t k = static_cast<std::size_t>(above - curve.x.begin());
    if (std::abs(curve.x[k] - x) < kSameX) return curve.y[k];
    if (k == 0) return std::nullopt;
    const double t = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
    return curve.y[k - 1] + t * (curve.y[k] - curve.y[k - 1]);
}

std::vector<LegendEntry> legend_of(const CurveSet& set) {
    std::vector<LegendEntry> legend;
    for (const PlotCurve& curve : set.curves) {
        const bool errors = set.error_band && !curve.error.empty();
        const bool band = errors && curve.look == CurveLook::Line;
        const QString range = QStringLiteral(" ± 1 standard error");
        legend.push_back({band ? curve.name + range : curve.name, curve.ink, curve.look, band});
    }
    return legend;
}

QRectF below_heading(const QRectF& area, const PlotStyle& style, const QString& title,
                     const std::vector<LegendEntry>& legend) {
    const double below_title = area.top() + title_height(style, title);
    const auto entries = placed(legend, area, style, below_title);
    const double bottom =
        entries.empty() ? below_title : entries.back().place.y() + 0.9 * style.line_height();
    return {QPointF(area.left(), bottom), area.bottomRight()};
}

QRectF paint_heading(QPainter& painter, const QRectF& area, const PlotStyle& style,
                     const QString& title, const std::vector<LegendEntry>& legend) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(area, style.paper);
    const double height = title_height(style, title);
    painter.setPen(style.text);
    painter.setFont(style.title);
    painter.drawText(QRectF(area.left() + 0.5 * style.line_height(), area.top(),
                            area.width() - style.line_height(), height),
                     Qt::AlignLeft | Qt::AlignVCenter, title);
    for (const PlacedEntry& entry : placed(legend, area, style, area.top() + height))
        paint_entry(painter, style, entry);
    return below_heading(area, style, title, legend);
}

QPen pen_of(const PlotStyle& style, PlotInk ink, CurveLook look) {
    const double width = style.line_height() / 9;
    QPen pen(style.ink(ink), look == CurveLook::Dashes ? 0.85 * width : width, Qt::SolidLine,
             Qt::RoundCap, Qt::RoundJoin);
    if (look == CurveLook::Dashes) {
        pen.setCapStyle(Qt::FlatCap);
        pen.setDashPattern(dashes_of(ink));
    }
    return pen;
}

void paint_band(QPainter& painter, const PlotStyle& style, const PlotCurve& curve, float opacity,
                const std::function<QPointF(double, double)>& place) {
    QPolygonF band;
    const auto add = [&](std::size_t k, double sign) {
        const double error = std::isfinite(curve.error[k]) ? curve.error[k] : 0.0;
        band << place(curve.x[k], curve.y[k] + sign * error);
    };
    for (std::size_t k = 0; k < curve.x.size(); ++k) add(k, 1);
    for (std::size_t k = curve.x.size(); k-- > 0;) add(k, -1);
    QColor colour = style.ink(curve.ink);
    colour.setAlphaF(opacity);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(band);
    painter.setBrush(Qt::NoBrush);
}

void paint_dot(QPainter& painter, const PlotStyle& style, QPointF place, PlotInk ink) {
    const double radius = 0.22 * style.line_height();
    painter.setPen(QPen(style.paper, 0.35 * radius));
    painter.setBrush(style.ink(ink));
    painter.drawEllipse(place, radius, radius);
    painter.setBrush(Qt::NoBrush);
}

}  // namespace asperity::studio
