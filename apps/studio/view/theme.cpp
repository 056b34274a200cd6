// SPDX-License-Identifier: Apache-2.0
#include "theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

#include <cmath>

namespace asperity::studio {

namespace {

/// The colours that a theme is made of.
struct Colours {
    QColor window, base, raised, text, faint, accent, link, tooltip;
};

const Colours kDark{{"#25282d"}, {"#1b1d21"}, {"#343941"}, {"#e4e7eb"},
                    {"#8b939e"}, {"#4a90d9"}, {"#74b3f0"}, {"#3b4149"}};
const Colours kLight{{"#f3f4f6"}, {"#ffffff"}, {"#e3e7ec"}, {"#1d2126"},
                     {"#737b85"}, {"#2c6fb7"}, {"#1f5ea3"}, {"#fffbe8"}};

QPalette palette_of(const Colours& colours) {
    QPalette palette;
    palette.setColor(QPalette::Window, colours.window);
    palette.setColor(QPalette::WindowText, colours.text);
    palette.setColor(QPalette::Base, colours.base);
    palette.setColor(QPalette::AlternateBase, mix(colours.base, colours.raised, 0.4));
    palette.setColor(QPalette::Text, colours.text);
    palette.setColor(QPalette::PlaceholderText, colours.faint);
    palette.setColor(QPalette::Button, colours.raised);
    palette.setColor(QPalette::ButtonText, colours.text);
    palette.setColor(QPalette::BrightText, QColor("#ff5c5c"));
    palette.setColor(QPalette::Highlight, colours.accent);
    palette.setColor(QPalette::HighlightedText, Qt::white);
    palette.setColor(QPalette::Link, colours.link);
    palette.setColor(QPalette::LinkVisited, colours.link);
    palette.setColor(QPalette::ToolTipBase, colours.tooltip);
    palette.setColor(QPalette::ToolTipText, colours.text);

    // Edges, from the lightest to the darkest
    palette.setColor(QPalette::Light, colours.raised.lighter(125));
    palette.setColor(QPalette::Midlight, colours.raised.lighter(110));
    palette.setColor(QPalette::Mid, mix(colours.window, colours.faint, 0.35));
    palette.setColor(QPalette::Dark, mix(colours.window, colours.faint, 0.55));
    palette.setColor(QPalette::Shadow, mix(colours.base, Qt::black, 0.6));

    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, mix(colours.window, colours.faint, 0.75));
    palette.setColor(QPalette::Disabled, QPalette::Highlight, colours.faint);
    return palette;
}

bool is_dark_colour(const QColor& colour) {
    return colour.lightnessF() < 0.5F;
}

/// As the desktop had it when the program began.
bool is_system_dark() {
    static const bool dark = is_dark_colour(QApplication::palette().color(QPalette::Window));
    return dark;
}

}  // namespace

void apply_theme(Theme theme) {
    const bool system_dark = is_system_dark();
    const bool dark = theme == Theme::Dark || (theme == Theme::System && system_dark);
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    QApplication::setPalette(palette_of(dark ? kDark : kLight));
}

bool is_dark() {
    return is_dark_colour(QApplication::palette().color(QPalette::Window));
}

QColor mix(const QColor& first, const QColor& second, double share) {
    const auto between = [share](int a, int b) {
        return static_cast<int>(std::lround(a + share * (b - a)));
    };
    return {between(first.red(), second.red()), between(first.green(), second.green()),
            between(first.blue(), second.blue())};
}

}  // namespace asperity::studio
