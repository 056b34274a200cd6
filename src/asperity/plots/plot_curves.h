// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot.h"

#include <QPolygonF>

#include <functional>
#include <vector>

namespace asperity::studio {

enum class CurveLook { Line, Dashes, Marks };

/// Values over the x of a plot.
struct PlotCurve {
    QString name;    ///< in the legend
    QString column;  ///< in a table: name and unit
    PlotInk ink = PlotInk::Simulated;
    CurveLook look = CurveLook::Line;
    std::vector<double> x, y;
    std::vector<double> error;  ///< standard error of y; empty: exact
    std::vector<int> cells;     ///< of the detector; empty: these are no cells
    QString brief = {};         ///< in a read-out; empty: the name
};

/// What the plots of curves have in common: a title, curves, what they are called.
struct CurveSet {
    QString title;
    QString x_name, x_unit;  ///< "θₒ", "°"
    QString x_column;        ///< in a table
    QString y_name, y_unit;  ///< "f", "sr⁻¹"
    bool error_band = true;  ///< errors are shown
    std::vector<PlotCurve> curves;
    std::vector<PlotTable::Column> more;  ///< columns of a table only, over the x of the first

    bool empty() const { return curves.empty(); }
    /// Largest value to be shown. Models may stand out of a measurement four times its size; what
    /// is beyond is cut off.
    double top() const;
    /// The x of the first curve nearest to `x`, and all curves' values there.
    std::size_t nearest(double x) const;
    QString reading_at(std::size_t k) const;
    PlotTable table() const;
};

/// Value of a curve at `x`: that of its point there, or between two neighbours; none outside.
std::optional<double> value_at(const PlotCurve& curve, double x);

/// An entry of a legend.
struct LegendEntry {
    QString text;
    PlotInk ink;
    CurveLook look = CurveLook::Line;
    bool band = false;
};
std::vector<LegendEntry> legend_of(const CurveSet& set);

/// Paints paper, title and legend; returns what is left of `area` below them.
QRectF paint_heading(QPainter& painter, const QRectF& area, const PlotStyle& style,
                     const QString& title, const std::vector<LegendEntry>& legend);
/// The same area, without painting.
QRectF below_heading(const QRectF& area, const PlotStyle& style, const QString& title,
                     const std::vector<LegendEntry>& legend);

/// The pen a curve is drawn with.
QPen pen_of(const PlotStyle& style, PlotInk ink, CurveLook look);
/// The band of a curve's errors, whose points lie at place(x, y +- error).
void paint_band(QPainter& painter, const PlotStyle& style, const PlotCurve& curve, float opacity,
                const std::function<QPointF(double, double)>& place);
/// A dot with a rim of paper, so that it stands out of lines.
void paint_dot(QPainter& painter, const PlotStyle& style, QPointF place, PlotInk ink);

}  // namespace asperity::studio
