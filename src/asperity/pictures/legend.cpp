// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/legend.h>

#include <asperity/pictures/stroke_font.h>
#include <fmt/format.h>

#include <cmath>

namespace asperity::io {

namespace {

constexpr Colour kMark = {1, 1, 1};
constexpr Colour kMarkShadow = {0, 0, 0};

/// "0.01", "20", "2×10⁻⁵".
std::string value_text(double value) {
    if (value == 0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    if (exponent >= -3 && exponent <= 3) return fmt::format("{:.4g}", value);
    const double mantissa = value / std::pow(10.0, exponent);
    std::string text = std::abs(mantissa - 1) < 1e-6 ? "10" : fmt::format("{:.3g}×10", mantissa);
    if (exponent < 0) text += "⁻";
    const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
    return text;
}

std::vector<Tick> log_ticks(const ValueScale& scale) {
    constexpr double kRoomForLabel = 0.07;  // of the bar, kept free below the top label
    std::vector<Tick> ticks;
    const int first = static_cast<int>(std::floor(std::log10(scale.low) + 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(scale.high) + 1e-9));
    const int step = 1 + (last - first) / 9;
    for (int exponent = first; exponent <= last; ++exponent) {
        for (int digit = 1; digit < (step == 1 ? 10 : 2); ++digit) {
            const double value = digit * std::pow(10.0, exponent);
            if (value < scale.low * (1 - 1e-9) || value > scale.high * (1 - 1e-9)) continue;
            const double t = scale.position(value);
            const bool labelled =
                digit == 1 && (last - exponent) % step == 0 && t < 1 - kRoomForLabel;
            ticks.push_back({t, labelled ? value_text(value) : ""});
        }
    }
    return ticks;
}

std::vector<Tick> linear_ticks(const ValueScale& scale) {
    std::vector<Tick> ticks;
    constexpr int kParts = 5;
    for (int k = 0; k < kParts; ++k) {
        const double value = scale.high * k / kParts;
        ticks.push_back({scale.position(value), k == 0 ? "" : value_text(value)});
    }
    return ticks;
}

/// A place `t` along the bar and `across` pixels beyond its labelled side.
Point beside_bar(Rect bar, BarDirection direction, double t, double across) {
    if (direction == BarDirection::Upright)
        return {bar.right() + across, bar.bottom() - t * bar.height};
    return {bar.x + t * bar.width, bar.bottom() + across};
}

void draw_label(Canvas& canvas, Rect bar, BarDirection direction, const Tick& tick,
                const Theme& theme) {
    const TextStyle style{theme.small, theme.text};
    const double unit = theme.small / 13;
    const double length = unit * (tick.label.empty() ? 3 : 6);
    canvas.line(beside_bar(bar, direction, tick.t, 2), beside_bar(bar, direction, tick.t, length),
                unit, theme.faint_text, tick.label.empty() ? 0.6 : 1.0);
    if (direction == BarDirection::Upright) {
        const Point at = beside_bar(bar, direction, tick.t, 11 * unit);
        draw_text(canvas, {at.x, at.y + 0.36 * theme.small}, tick.label, style);
    } else {
        const Point at = beside_bar(bar, direction, tick.t, 9 * unit + 0.72 * theme.small);
        draw_text(canvas, at, tick.label, style, Align::Centre);
    }
}

}  // namespace

Theme light_theme() {
    Theme theme;
    theme.background = {1, 1, 1};
    theme.text = {0.067, 0.067, 0.067};
    theme.faint_text = {0.30, 0.30, 0.33};
    theme.frame = {0.62, 0.62, 0.65};
    return theme;
}

Theme theme_of(const SkyMapSettings& settings) {
    return settings.light ? light_theme() : Theme{};
}

std::vector<Tick> ticks_of(const ValueScale& scale) {
    std::vector<Tick> ticks = scale.scale == Scale::Log ? log_ticks(scale) : linear_ticks(scale);
    ticks.push_back({1.0, (scale.clipped ? "≥ " : "") + value_text(scale.high)});
    return ticks;
}

void draw_colour_bar(Canvas& canvas, Rect bar, BarDirection direction, const ValueScale& scale,
                     ColourMap map, const Theme& theme) {
    const bool upright = direction == BarDirection::Upright;
    const int length = upright ? bar.height : bar.width;
    for (int k = 0; k < length; ++k) {
        const Rect slice = upright ? Rect{bar.x, bar.bottom() - 1 - k, bar.width, 1}
                                   : Rect{bar.x + k, bar.y, 1, bar.height};
        canvas.fill(slice, colour_of(map, (k + 0.5) / length));
    }
    canvas.frame(bar, theme.frame);
    for (const Tick& tick : ticks_of(scale)) draw_label(canvas, bar, direction, tick, theme);

    // The swatch of cells that received nothing, apart from the bar: a log scale never reaches 0.
    const int side = upright ? bar.width : bar.height;
    const int gap = upright ? side : 2 * side;
    const Rect swatch = upright ? Rect{bar.x, bar.bottom() + gap, side, side}
                                : Rect{bar.x - gap - side, bar.y, side, side};
    canvas.fill(swatch, kZeroColour);
    canvas.frame(swatch, theme.frame);
    draw_label(canvas, swatch, direction, {0.5, "0"}, theme);
}

void draw_grid(Canvas& canvas, Rect area, Projection projection, double opacity) {
    const auto place = [&](double theta_deg, double phi_deg) {
        return place_of(radians(theta_deg), radians(phi_deg), area, projection);
    };
    const Point c = area.centre();
    std::vector<Polyline> lines;
    std::vector<double> radii;
    for (const double theta : {30.0, 60.0}) {
        const double y = std::floor(place(theta, 0).y) + 0.5;
        if (projection == Projection::SkyMap)
            lines.push_back({{area.x + 0.5, y}, {area.right() - 0.5, y}});
        else
            radii.push_back(place(theta, 0).x - c.x);
    }
    for (const double phi : {90.0, 180.0, 270.0}) {
        const double x = std::floor(place(0, phi).x) + 0.5;
        if (projection == Projection::SkyMap)
            lines.push_back({{x, area.y + 0.5}, {x, area.bottom() - 0.5}});
    }
    if (projection == Projection::Disk) {
        const double x = std::floor(c.x) + 0.5, y = std::floor(c.y) + 0.5, r = 0.5 * area.width;
        lines.push_back({{x - r, y}, {x + r, y}});
        lines.push_back({{x, y - r}, {x, y + r}});
    }
    // A light line in a soft dark one shows on every colour.
    for (const double width : {3.0, 1.0}) {
        const Colour colour = width > 1 ? kMarkShadow : kMark;
        const double share = width > 1 ? 0.5 * opacity : opacity;
        for (const Polyline& line : lines) canvas.line(line[0], line[1], width, colour, share);
        for (const double radius : radii) canvas.circle(c, radius, width, colour, share);
    }
}

void draw_ring(Canvas& canvas, Point at, double radius) {
    const double width = std::max(1.2, 0.28 * radius);
    canvas.circle(at, radius, width + 2, kMarkShadow, 0.55);
    canvas.circle(at, radius, width, kMark);
}

void draw_dot(Canvas& canvas, Point at, double radius) {
    canvas.disc(at, 0.55 * radius + 1.2, kMarkShadow, 0.55);
    canvas.disc(at, 0.55 * radius, kMark);
}

void draw_marks(Canvas& canvas, Rect area, const Layer& layer, Projection projection,
                double radius) {
    draw_dot(canvas, place_of(layer.theta_i, layer.phi_i, area, projection), radius);
    draw_ring(canvas, place_of(layer.theta_i, layer.phi_i + kPi, area, projection), radius);
}

}  // namespace asperity::io
