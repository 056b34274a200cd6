// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot.h>

#include <functional>
#include <vector>

namespace asperity::plots {

enum class CurveLook { Line, Dashes, Marks };

/// Values over the x of a plot.
struct PlotCurve {
    std::string name;    ///< in the legend
    std::string column;  ///< in a table: name and unit
    PlotInk ink = PlotInk::Simulated;
    CurveLook look = CurveLook::Line;
    std::vector<double> x, y;
    std::vector<double> error;  ///< standard error of y; empty: exact
    std::vector<int> cells;     ///< of the detector; empty: these are no cells
    std::string brief = {};     ///< in a read-out; empty: the name
};

/// What the plots of curves have in common: a title, curves, what they are called.
struct CurveSet {
    std::string title;
    std::string x_name, x_unit;  ///< "θₒ", "°"
    std::string x_column;        ///< in a table
    std::string y_name, y_unit;  ///< "f", "sr⁻¹"
    bool error_band = true;      ///< errors are shown
    std::string note = {};       ///< below the title, what a reader should know of the curves
    double height_share = 0.66;  ///< of the width, where the plot may choose its height
    std::vector<PlotCurve> curves;
    std::vector<PlotTable::Column> more;  ///< columns of a table only, over the x of the first

    bool empty() const { return curves.empty(); }
    /// Largest value to be shown. Models may stand out of a measurement four times its size, and
    /// the end of a curve twice its neighbour: the row at the horizon is often such a spike. What
    /// is beyond is cut off.
    double top() const;
    /// Says what lies above an axis that ends at `high`; empty when nothing does.
    std::string cut_off(double high) const;
    /// The note and what is cut off.
    std::string note_with(double high) const;
    /// The x of the first curve nearest to `x`, and all curves' values there.
    std::size_t nearest(double x) const;
    std::string reading_at(std::size_t k) const;
    PlotTable table() const;
};

/// Value of a curve at `x`: that of its point there, or between two neighbours; none outside.
std::optional<double> value_at(const PlotCurve& curve, double x);

/// An entry of a legend.
struct LegendEntry {
    std::string text;
    PlotInk ink;
    CurveLook look = CurveLook::Line;
    bool band = false;
};
std::vector<LegendEntry> legend_of(const CurveSet& set);

/// What stands above a plot.
struct Heading {
    std::string title, note = {};
    std::vector<LegendEntry> legend = {};
};
/// Paints paper, title, note and legend; returns what is left of `area` below them.
Box paint_heading(Canvas& canvas, const Box& area, const PlotStyle& style, const Heading& heading);
/// The same area, without painting.
Box below_heading(const Box& area, const PlotStyle& style, const Heading& heading);

// The parts of a heading, for plots that have room for its legend elsewhere.

/// Lines of title and note, with the room that each takes.
struct PlacedLine {
    std::string text;
    Box box;
    bool title = false;
};
std::vector<PlacedLine> placed_lines(const Box& area, const PlotStyle& style,
                                     const Heading& heading);
/// Where the legend, or the plot, begins.
double below_lines(const Box& area, const PlotStyle& style, const Heading& heading);
void paint_lines(Canvas& canvas, const PlotStyle& style, const std::vector<PlacedLine>& lines);

struct PlacedEntry {
    LegendEntry entry;
    Place place;  ///< left end of the sample, middle of the text
};
/// From left to right, as many to a row as fit, below `top`.
std::vector<PlacedEntry> placed_entries(const std::vector<LegendEntry>& legend, const Box& area,
                                        const PlotStyle& style, double top);
/// The room an entry takes.
Box box_of(const PlacedEntry& placed, const PlotStyle& style);
void paint_entry(Canvas& canvas, const PlotStyle& style, const PlacedEntry& placed);

/// The stroke a curve is drawn with.
Stroke stroke_of(const PlotStyle& style, PlotInk ink, CurveLook look);
/// The band of a curve's errors, whose points lie at place(x, y +- error).
void paint_band(Canvas& canvas, const PlotStyle& style, const PlotCurve& curve, double opacity,
                const std::function<Place(double, double)>& place);
/// A dot with a rim of paper, so that it stands out of lines.
void paint_dot(Canvas& canvas, const PlotStyle& style, Place place, PlotInk ink);

}  // namespace asperity::plots
