// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot_axis.h>
#include <asperity/plots/plot_curves.h>

namespace asperity::plots {

/// The axes of a polar plot over half a disc: the angle from the normal, which points up, positive
/// to the right; the value outwards from the centre.
class PolarFrame {
  public:
    PolarFrame(Place centre, double radius, PlotAxis axis, const PlotStyle& style);

    Place centre() const { return centre_; }
    double radius() const { return radius_; }
    /// `theta` in degrees. Values off the axis lie on the rim or in the centre.
    Place map(double theta_deg, double value) const;
    /// Degrees; none below the base line or off the disc.
    std::optional<double> theta_at(Place place) const;

    void paint_axes(Canvas& canvas) const;
    void paint_line(Canvas& canvas, const PlotCurve& curve) const;
    void paint_band(Canvas& canvas, const PlotCurve& curve) const;
    /// A ray of light coming in from the rim at `theta_deg`.
    void paint_light(Canvas& canvas, double theta_deg) const;
    /// A dashed line from the centre to the rim.
    void paint_direction(Canvas& canvas, double theta_deg, const Stroke& stroke) const;

  private:
    Place on_circle(double theta_deg, double radius) const;
    void paint_angles(Canvas& canvas) const;
    void paint_rings(Canvas& canvas) const;

    PlotAxis axis_;
    const PlotStyle& style_;
    Place centre_;
    double radius_ = 1;
};

/// A lobe in a plane through the normal; x of the curves is theta_o in degrees.
class PolarPlot final : public Plot {
  public:
    /// Light from -theta_i, none where it does not lie in the plane.
    PolarPlot(CurveSet set, PlotAxis radius, std::vector<double> theta_i_deg);

    void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(Place place, const Box& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override { return set_.table(); }
    double height_for(double width, const PlotStyle& style) const override;
    /// The axes as paint() has them in `area`.
    PolarFrame frame(const Box& area, const PlotStyle& style) const;

  private:
    /// The disc is made as large as words and legend leave room for: these stand in the corners
    /// beside it, or above where that gives more.
    struct Layout {
        Place centre;
        double radius = 1;
        std::vector<PlacedEntry> entries;
    };
    Heading heading() const;
    Layout layout(const Box& area, const PlotStyle& style) const;
    Layout legend_above(const Box& area, const PlotStyle& style) const;
    Layout legend_in_corners(const Box& area, const PlotStyle& style) const;

    CurveSet set_;
    PlotAxis axis_;
    std::vector<double> theta_i_deg_;
};

}  // namespace asperity::plots
