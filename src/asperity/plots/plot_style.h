// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>

namespace asperity::studio {

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
};

/// Colours and type of a plot: dark on light for paper, or as the palette has it.
///
/// The inks are told apart by the colour-blind as well (after Okabe and Ito 2008, "Color universal
/// design", made lighter on dark paper). Text is sized in the device-independent pixels of the font
/// given, so that a plot is laid out alike on a widget, in an image and in an SVG file.
struct PlotStyle {
    PlotStyle(const QPalette& palette, const QFont& font);
    /// For print: black on white.
    explicit PlotStyle(const QFont& font);

    QColor ink(PlotInk what) const;
    /// Height of a line of text, the measure of all distances.
    double line_height() const;
    double width_of(const QString& text) const;

    QColor paper, text, faint, grid;
    QFont font, small, title;
    bool dark = false;

  private:
    void set_font(const QFont& of_widget);
};

}  // namespace asperity::studio
