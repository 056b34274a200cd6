// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/pictures/canvas.h>
#include <asperity/pictures/layer_view.h>

#include <string>
#include <vector>

namespace asperity::io {

/// Colours and type of everything around the data.
struct Theme {
    Colour background = {0.063, 0.071, 0.090};
    Colour text = {0.925, 0.933, 0.945};
    Colour faint_text = {0.600, 0.635, 0.685};
    Colour frame = {0.260, 0.285, 0.330};
    double title = 20, body = 14, small = 13;  ///< sizes of type [pixels]
};

/// The same for paper: dark on white.
Theme light_theme();
Theme theme_of(const SkyMapSettings& settings);

/// A value beside a colour bar: t = 0 at its low end, 1 at its high end.
struct Tick {
    double t = 0;
    std::string label;  ///< empty: a short mark without a label
};

/// Decades (and marks between them) of a log scale, round steps of a linear one; the top value
/// always has its label, "≥ 5" when cells lie above it.
std::vector<Tick> ticks_of(const ValueScale& scale);

enum class BarDirection { Upright, Lying };

/// Draws a colour bar with frame, ticks and labels, and a swatch for "0" beyond its low end.
/// Labels stand to the right of an upright bar and below a lying one.
void draw_colour_bar(Canvas& canvas, Rect bar, BarDirection direction, const ValueScale& scale,
                     ColourMap map, const Theme& theme);

/// Lines of equal theta_o and phi_o, faint, over a painted layer.
void draw_grid(Canvas& canvas, Rect area, Projection projection, double opacity);

/// A ring where a perfect mirror would send the light and a dot where it comes from.
void draw_marks(Canvas& canvas, Rect area, const Layer& layer, Projection projection,
                double radius);
void draw_ring(Canvas& canvas, Point at, double radius);
void draw_dot(Canvas& canvas, Point at, double radius);

}  // namespace asperity::io
