// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace asperity::plots {

/// A place on an axis: with a label and a line across the plot, or a short mark between those.
struct PlotTick {
    double value = 0;
    std::string label = {};  ///< empty: a short mark
};

/// One axis of a plot: its range and how values spread over it.
struct PlotAxis {
    std::string label;  ///< with the unit
    double low = 0, high = 1;
    bool log = false;
    double step = 0;  ///< between labels of a linear axis; 0: chosen

    /// 0 at `low`, 1 at `high`; on a log axis, what is not positive lies at minus infinity.
    double position(double value) const;
    double value_at(double position) const;
    /// Labelled about every 1 / `count` of the axis: at 1, 2 or 5 times a power of ten, on a log
    /// axis at powers of ten; short marks between them where there is room.
    std::vector<PlotTick> ticks(int count) const;
};

/// An axis between two values, ends rounded outwards to ticks about a fifth of it apart.
PlotAxis axis_between(double low, double high);

/// From 0, or on a log axis `decades` below, to the first tick not below `top`.
PlotAxis axis_up_to(double top, bool log, double decades);

/// "10⁻³", "0.25", "2×10⁻⁵": as few digits as the step between labels needs.
std::string number_label(double value, double step);

/// A value for people: four significant digits; of an error, two.
std::string value_text(double value);
std::string error_text(double error);

}  // namespace asperity::plots
