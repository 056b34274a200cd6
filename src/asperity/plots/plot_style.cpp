// SPDX-License-Identifier: Apache-2.0
#include "plot_style.h"

#include "theme.h"

#include <QFontInfo>
#include <QFontMetricsF>

#include <algorithm>
#include <array>

namespace asperity::studio {

namespace {

struct InkPair {
    const char *on_light, *on_dark;
};

// In the order of PlotInk.
constexpr std::array<InkPair, 11> kInks = {{
    {"#0b62a8", "#5db4f2"},  // simulated: blue
    {"#d1500a", "#ff9152"},  // Cook-Torrance: vermilion
    {"#00805d", "#3fd6a6"},  // GGX: green
    {"#a3407f", "#e88fc4"},  // Beckmann: purple
    {"#111111", "#f2f2f2"},  // all bounces: as text
    {"#08306b", "#c9def2"},  // one reflection, and more, from deep to bright
    {"#2171b5", "#74b6e8"},
    {"#5aa0d0", "#3d86c6"},
    {"#c98a00", "#ffd24a"},  // all higher orders: gold
    {"#b58900", "#ffd24a"},  // light: yellow
    {"#5a5a5a", "#b8b8b8"},  // mirror direction: grey
}};

QFont scaled(QFont font, double factor) {
    font.setPixelSize(std::max(1, static_cast<int>(font.pixelSize() * factor + 0.5)));
    return font;
}

}  // namespace

PlotStyle::PlotStyle(const QPalette& palette, const QFont& of_widget)
    : paper(palette.color(QPalette::Base)),
      text(palette.color(QPalette::Text)),
      faint(mix(text, paper, 0.35)),
      grid(mix(paper, text, 0.13)),
      dark(paper.lightnessF() < 0.5F) {
    set_font(of_widget);
}

PlotStyle::PlotStyle(const QFont& of_widget)
    : paper(Qt::white), text("#111111"), faint("#444444"), grid("#dddddd") {
    set_font(of_widget);
}

void PlotStyle::set_font(const QFont& of_widget) {
    font = of_widget;
    font.setPixelSize(QFontInfo(of_widget).pixelSize());
    small = scaled(font, 0.9);
    title = scaled(font, 1.1);
    title.setBold(true);
}

QColor PlotStyle::ink(PlotInk what) const {
    const InkPair& pair = kInks[static_cast<std::size_t>(what)];
    return QColor(dark ? pair.on_dark : pair.on_light);
}

double PlotStyle::line_height() const {
    return QFontMetricsF(font).height();
}

double PlotStyle::width_of(const QString& words) const {
    return QFontMetricsF(font).horizontalAdvance(words);
}

}  // namespace asperity::studio
