// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot_axis.h"
#include "plot_curves.h"

namespace asperity::studio {

/// The axes of a polar plot over half a disc: the angle from the normal, which points up, positive
/// to the right; the value outwards from the centre.
class PolarFrame {
  public:
    PolarFrame(const QRectF& area, PlotAxis radius, const PlotStyle& style);

    QPointF centre() const { return centre_; }
    double radius() const { return radius_; }
    /// `theta` in degrees. Values off the axis lie on the rim or in the centre.
    QPointF map(double theta_deg, double value) const;
    /// Degrees; none below the base line or off the disc.
    std::optional<double> theta_at(QPointF place) const;

    void paint_axes(QPainter& painter) const;
    void paint_line(QPainter& painter, const PlotCurve& curve) const;
    void paint_band(QPainter& painter, const PlotCurve& curve) const;
    /// A ray of light coming in from the rim at `theta_deg`.
    void paint_light(QPainter& painter, double theta_deg) const;
    /// A dashed line from the centre over the rim.
    void paint_direction(QPainter& painter, double theta_deg, const QPen& pen) const;

  private:
    QPointF on_circle(double theta_deg, double radius) const;

    PlotAxis axis_;
    const PlotStyle& style_;
    QPointF centre_;
    double radius_ = 1;
};

/// A lobe in the plane of incidence; x of the curves is theta_o in degrees.
class PolarPlot final : public Plot {
  public:
    PolarPlot(CurveSet set, PlotAxis radius, double theta_i_deg);

    void paint(QPainter& painter, const QRectF& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(QPointF place, const QRectF& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override { return set_.table(); }
    /// The axes as paint() has them in `area`.
    PolarFrame frame(const QRectF& area, const PlotStyle& style) const;

  private:
    std::vector<LegendEntry> legend() const;

    CurveSet set_;
    PlotAxis axis_;
    double theta_i_deg_;
};

}  // namespace asperity::studio
