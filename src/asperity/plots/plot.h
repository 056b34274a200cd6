// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot_style.h"

#include <QLineF>
#include <QPainter>
#include <QPointF>
#include <QRectF>
#include <QString>

#include <optional>
#include <vector>

namespace asperity::studio {

/// Numbers of a plot for a file: columns with their units, as exact as they are. What is not a
/// number is left empty.
struct PlotTable {
    struct Column {
        QString header;
        std::vector<double> values;
    };
    std::vector<Column> columns;
};

/// What a plot has to say about a place.
struct PlotReading {
    QString text;             ///< one line, values with errors and units
    std::optional<int> cell;  ///< of the detector
    QLineF guide;             ///< through the place, to be drawn over the plot; null: none
    struct Dot {
        QPointF place;
        PlotInk ink;
    };
    std::vector<Dot> dots;  ///< the values on their curves
};

/// A plot of fixed data. Paints onto any device: a widget, an image, an SVG file; the same style
/// and area give the same layout on all of them.
class Plot {
  public:
    virtual ~Plot() = default;
    virtual void paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const = 0;
    /// None where there is nothing to read.
    virtual std::optional<PlotReading> reading(QPointF place, const QRectF& area,
                                               const PlotStyle& style) const = 0;
    virtual PlotTable table() const = 0;
};

}  // namespace asperity::studio
