// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot_axis.h"
#include "plot_curves.h"

namespace asperity::studio {

/// The axes of a plot in their place on a device, and curves drawn between them.
class PlotFrame {
  public:
    /// `area`: of axes and labels together.
    PlotFrame(const QRectF& area, PlotAxis x, PlotAxis y, const PlotStyle& style);

    /// The rectangle between the axes.
    const QRectF& inside() const { return inside_; }
    QPointF map(double x, double y) const;
    double x_at(double place) const;

    void paint_axes(QPainter& painter) const;
    /// A line; what lies above or below the axes is cut off. Gaps where y is not a number.
    void paint_line(QPainter& painter, const PlotCurve& curve) const;
    /// From y - error to y + error.
    void paint_band(QPainter& painter, const PlotCurve& curve) const;
    /// A dot at each point, with a bar from y - error to y + error when `errors`.
    void paint_marks(QPainter& painter, const PlotCurve& curve, bool errors) const;
    /// A vertical line over the whole height.
    void paint_upright(QPainter& painter, double x, const QPen& pen) const;

  private:
    double y_place(double y) const;  ///< may be infinite
    double clamped(double place) const;

    PlotAxis x_, y_;
    const PlotStyle& style_;
    QRectF inside_;
    std::vector<PlotTick> x_ticks_, y_ticks_;
};

/// Lines and marks over two straight axes.
class CurvePlot final : public Plot {
  public:
    /// A vertical line with an entry in the legend.
    struct Upright {
        double x = 0;
        QString name;
        PlotInk ink = PlotInk::Mirror;
    };

    CurvePlot(CurveSet set, PlotAxis x, PlotAxis y, std::vector<Upright> uprights = {});

    void paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(QPointF place, const QRectF& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override { return set_.table(); }
    /// The axes as paint() has them in `area`.
    PlotFrame frame(const QRectF& area, const PlotStyle& style) const;

  private:
    std::vector<LegendEntry> legend() const;

    CurveSet set_;
    PlotAxis x_, y_;
    std::vector<Upright> uprights_;
};

}  // namespace asperity::studio
