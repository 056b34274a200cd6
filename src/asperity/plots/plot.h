// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/canvas.h>
#include <asperity/plots/plot_style.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::plots {

/// Numbers of a plot for a file: columns with their units, as exact as they are. What is not a
/// number is left empty.
struct PlotTable {
    struct Column {
        std::string header;
        std::vector<double> values;
    };
    std::vector<Column> columns;
};

/// The table as text: a line of headers, then a line for each row, numbers with all their digits,
/// separated by commas; what is not finite is left empty.
std::string csv_text(const PlotTable& table);

/// What a plot has to say about a place.
struct PlotReading {
    std::string text;                              ///< one line, values with errors and units
    std::optional<int> cell;                       ///< of the detector
    std::optional<std::pair<Place, Place>> guide;  ///< a line through the place, to be drawn over
    struct Dot {
        Place place;
        PlotInk ink;
    };
    std::vector<Dot> dots;  ///< the values on their curves
};

/// A plot of fixed data. Paints onto any canvas: a widget, an image, a drawing; the same style and
/// area give the same layout on all of them.
class Plot {
  public:
    virtual ~Plot() = default;
    virtual void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const = 0;
    /// None where there is nothing to read.
    virtual std::optional<PlotReading> reading(Place place, const Box& area,
                                               const PlotStyle& style) const = 0;
    virtual PlotTable table() const = 0;
    /// Height that lets it fill an area of this width.
    virtual double height_for(double width, const PlotStyle& style) const = 0;
};

/// Says in the middle why there is no plot.
class MessagePlot final : public Plot {
  public:
    explicit MessagePlot(std::string message) : message_(std::move(message)) {}

    void paint(Canvas& canvas, const Box& area, const PlotStyle& style) const override;
    std::optional<PlotReading> reading(Place, const Box&, const PlotStyle&) const override {
        return std::nullopt;
    }
    PlotTable table() const override { return {}; }
    double height_for(double width, const PlotStyle&) const override { return 0.62 * width; }

  private:
    std::string message_;
};

}  // namespace asperity::plots
