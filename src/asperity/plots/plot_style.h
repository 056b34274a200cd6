// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/canvas.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::plots {

/// What is drawn, and so in which colour.
enum class PlotInk {
    Simulated,
    CookTorrance,
    Ggx,
    Beckmann,
    Total,
    FirstOrder,
    SecondOrder,
    ThirdOrder,
    HigherOrders,
    Light,
    Mirror,
    Fifth,  ///< of curves side by side: after the first four of this list
    Sixth,
    Seventh,
    Eighth,
};

/// Ink of the k-th of several curves, from 0; they begin anew after kSeriesInks.
inline constexpr int kSeriesInks = 8;
PlotInk series_ink(int k);

/// Colours and type of a plot: dark on light for paper, light on dark for screens, or as a desktop
/// has it.
///
/// The inks are told apart by the colour-blind as well (after Okabe and Ito 2008, "Color universal
/// design", made lighter on dark paper). Text is sized in units of the canvas, so that a plot is
/// laid out alike on a widget, in an image and in a drawing.
struct PlotStyle {
    /// For print: black on white.
    PlotStyle(std::shared_ptr<const TextMeasure> measure, double font_size);
    /// In the given colours, dark when the paper is.
    PlotStyle(std::shared_ptr<const TextMeasure> measure, double font_size, Colour paper_colour,
              Colour text_colour);
    static PlotStyle light(std::shared_ptr<const TextMeasure> measure, double font_size) {
        return {std::move(measure), font_size};
    }
    static PlotStyle dark_screen(std::shared_ptr<const TextMeasure> measure, double font_size);

    Colour ink(PlotInk what) const;
    /// Height of a line of text, the measure of all distances.
    double line_height() const;
    double width_of(std::string_view words) const { return width_of(words, font); }
    double width_of(std::string_view words, Font in) const;
    /// The text in lines not wider than this; a word that is wider keeps its line.
    std::vector<std::string> wrapped(const std::string& words, double width, Font in) const;

    Colour paper, text, faint, grid;
    Font font, small, title;
    bool dark = false;

  private:
    std::shared_ptr<const TextMeasure> measure_;
};

}  // namespace asperity::plots
