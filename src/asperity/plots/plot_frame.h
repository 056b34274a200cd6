// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot_axis.h>
#include <asperity/plots/plot_curves.h>

namespace asperity::plots {

/// The axes of a plot in their place on a canvas, and curves drawn between them.
class PlotFrame {
  public:
    /// `area`: of axes and labels together.
    PlotFrame(const Box& area, PlotAxis x, PlotAxis y, const PlotStyle& style);

    /// The box between the axes.
    const Box& inside() const { return inside_; }
    Place map(double x, double y) const;
    double x_at(double place) const;

    void paint_axes(Canvas& canvas) const;
    /// A line; what lies above or below the axes is cut off. Gaps where y is not a number.
    void paint_line(Canvas& canvas, const PlotCurve& curve) const;
    /// From y - error to y + error.
    void paint_band(Canvas& canvas, const PlotCurve& curve) const;
    /// A dot at each point, with a bar from y - error to y + error when `errors`.
    void paint_marks(Canvas& canvas, const PlotCurve& curve, bool errors) const;
    /// A vertical line over the whole height.
    void paint_upright(Canvas& canvas, double x, const Stroke& stroke) const;

  private:
    double y_place(double y) const;  ///< may be infinite
    double clamped(double place) const;
    void paint_x_ticks(Canvas& canvas) const;
    void paint_y_ticks(Canvas& canvas) const;

    PlotAxis x_, y_;
    const PlotStyle& style_;
    Box inside_;
    std::vector<PlotTick> x_ticks_, y_ticks_;
};

/// Lines and marks over two straight axes.
class CurvePlot final : public Plot {
  public:
    /// A vertical line with an entry in the legend, if it has a name.
    struct Upright {
        double x = 0;
        std::string name;
        PlotInk ink = PlotInk::Mirror;
    };

    CurvePlot(CurveSet set, PlotAxis x, PlotAxis y, std::vector<Upright> uprights = {});

    void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(Place place, const Box& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override { return set_.table(); }
    double height_for(double width, const PlotStyle&) const override {
        return set_.height_share * width;
    }
    /// The axes as paint() has them in `area`.
    PlotFrame frame(const Box& area, const PlotStyle& style) const;

  private:
    Heading heading() const;

    CurveSet set_;
    PlotAxis x_, y_;
    std::vector<Upright> uprights_;
};

}  // namespace asperity::plots
