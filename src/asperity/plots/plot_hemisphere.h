// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/plots/plot.h>
#include <asperity/plots/plot_axis.h>
#include <asperity/plots/plot_disc.h>

#include <memory>

namespace asperity::plots {

/// f over the cells of a hemisphere, for light from one direction.
struct HemisphereValues {
    std::string name;  ///< below the disc when there are several
    Detector detector;
    std::vector<double> values;  ///< f [1/sr] of the cells
    std::vector<double> errors;  ///< standard errors; empty: exact
    double theta_i = 0, phi_i = 0;
};

/// Those of a layer, of one channel or, for -1, the mean of all: channels share their rays, their
/// errors are added as wholly dependent.
HemisphereValues hemisphere_values(const Measurement& measurement, const Layer& layer, int channel);

/// An upright bar of the scale's colours with its values on the right and a name above.
void paint_colour_bar(Canvas& canvas, const Box& bar, const PlotStyle& style,
                      const io::ValueScale& scale, io::ColourMap map, const std::string& name);

/// The whole hemisphere of layers seen from above, as discs of radius sin(theta_o) with one scale;
/// phi_o = 0 to the right, counter-clockwise. Equal areas are equal projected solid angles.
class HemispherePlot final : public Plot {
  public:
    struct Data {
        std::string title, note;
        std::vector<HemisphereValues> discs;  ///< one or more
        io::ColourMap colour_map = io::ColourMap::Inferno;
        io::ValueScale scale;
        std::optional<int> cell;               ///< outlined on the first disc
        std::shared_ptr<DiscPainter> painter;  ///< for this plot and those that follow it, or null
    };
    explicit HemispherePlot(Data data);

    void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(Place place, const Box& area,
                                       const PlotStyle& style) const override;
    PlotTable table() const override;
    double height_for(double width, const PlotStyle& style) const override;

    /// The square around the k-th disc, as paint() has it in `area`.
    Box disc(const Box& area, const PlotStyle& style, std::size_t k = 0) const;
    /// Where a direction lies in `disc`.
    static Place place_of(const Box& disc, double theta, double phi);

  private:
    struct Layout;
    Layout layout(const Box& area, const PlotStyle& style) const;
    const Raster& image(std::size_t k, int pixels) const;
    void paint_grid(Canvas& canvas, const Box& disc, const PlotStyle& style) const;
    void paint_marks(Canvas& canvas, const Box& disc, const HemisphereValues& values) const;
    void paint_cell(Canvas& canvas, const Box& disc) const;
    void paint_bar(Canvas& canvas, const Box& bar, const PlotStyle& style) const;

    Data data_;
    mutable std::vector<Raster> images_;  ///< as painted last
};

}  // namespace asperity::plots
