// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/colour_map.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace asperity::io {

namespace {

/// A point of a colour map: at `t`, this chroma and hue (Oklab's a-b plane in polar coordinates).
struct Anchor {
    double t, chroma, hue_deg;
};

/// A colour map: lightness runs straight from `dark` to `light`, chroma and hue follow the anchors.
struct Recipe {
    double dark, light;
    std::span<const Anchor> anchors;
};

// Violet, blue, teal, green, yellow.
constexpr std::array<Anchor, 6> kViridis = {{{0.00, 0.115, 312},
                                             {0.22, 0.115, 282},
                                             {0.42, 0.092, 236},
                                             {0.60, 0.105, 175},
                                             {0.80, 0.165, 138},
                                             {1.00, 0.190, 107}}};
// Deep violet, purple, crimson, orange, pale yellow.
constexpr std::array<Anchor, 7> kInferno = {{{0.00, 0.055, 288},
                                             {0.18, 0.120, 302},
                                             {0.36, 0.165, 340},
                                             {0.54, 0.185, 378},
                                             {0.72, 0.175, 408},
                                             {0.86, 0.150, 440},
                                             {1.00, 0.080, 468}}};
constexpr std::array<Anchor, 2> kGrey = {{{0, 0, 0}, {1, 0, 0}}};
// The red of the thesis' sky-maps (hue of the screen's pure red), then glowing towards white.
constexpr std::array<Anchor, 5> kThesisRed = {{{0.00, 0.070, 29},
                                               {0.30, 0.170, 29},
                                               {0.56, 0.240, 31},
                                               {0.80, 0.145, 62},
                                               {1.00, 0.030, 95}}};

Recipe recipe_of(ColourMap map) {
    switch (map) {
        case ColourMap::Viridis:
            return {0.26, 0.93, kViridis};
        case ColourMap::Grey:
            return {0.24, 1.00, kGrey};
        case ColourMap::ThesisRed:
            return {0.19, 0.98, kThesisRed};
        case ColourMap::Inferno:
            break;
    }
    return {0.20, 0.97, kInferno};
}

/// Slope of a smooth curve at a point between two straight pieces of slopes `before` and `after`:
/// their harmonic mean, and level at a turning point, so that the curve never overshoots
/// (Fritsch and Butland 1984).
double slope_between(double before, double after) {
    return before * after > 0 ? 2 * before * after / (before + after) : 0.0;
}

/// Chroma and hue at t, on a smooth curve through the anchors.
Anchor interpolate(std::span<const Anchor> anchors, double t) {
    std::size_t k = 0;
    while (k + 2 < anchors.size() && t >= anchors[k + 1].t) ++k;
    const double step = anchors[k + 1].t - anchors[k].t;
    const double u = (t - anchors[k].t) / step;
    const auto curve = [&](double Anchor::*value) {
        const auto slope = [&](std::size_t n) {
            return (anchors[n + 1].*value - anchors[n].*value) / (anchors[n + 1].t - anchors[n].t);
        };
        const double from = anchors[k].*value, to = anchors[k + 1].*value;
        const double begin = k > 0 ? slope_between(slope(k - 1), slope(k)) : slope(k);
        const double end =
            k + 2 < anchors.size() ? slope_between(slope(k), slope(k + 1)) : slope(k);
        // Cubic Hermite.
        const double v = 1 - u;
        return v * v * (1 + 2 * u) * from + u * u * (1 + 2 * v) * to +
               u * v * step * (v * begin - u * end);
    };
    return {t, curve(&Anchor::chroma), curve(&Anchor::hue_deg)};
}

/// Oklab to linear sRGB, matrices as published by Ottosson.
std::array<double, 3> linear_rgb(double lightness, double a, double b) {
    const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
    return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
            -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
            -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

bool on_screen(const std::array<double, 3>& rgb) {
    return std::all_of(rgb.begin(), rgb.end(), [](double v) { return v >= 0 && v <= 1; });
}

/// The sRGB transfer curve (IEC 61966-2-1).
double encode(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// The colour of this lightness and hue, its chroma lowered until a screen can show it.
Colour screen_colour(double lightness, double chroma, double hue) {
    const auto rgb_at = [&](double c) {
        return linear_rgb(lightness, c * std::cos(hue), c * std::sin(hue));
    };
    double low = 0, high = chroma;
    if (!on_screen(rgb_at(chroma))) {
        for (int step = 0; step < 30; ++step) {
            const double middle = 0.5 * (low + high);
            (on_screen(rgb_at(middle)) ? low : high) = middle;
        }
        high = low;
    }
    const std::array<double, 3> rgb = rgb_at(high);
    return {encode(rgb[0]), encode(rgb[1]), encode(rgb[2])};
}

constexpr int kSteps = 512;
using Table = std::array<Colour, kSteps + 1>;

Table make_table(ColourMap map) {
    const Recipe recipe = recipe_of(map);
    Table table;
    for (int k = 0; k <= kSteps; ++k) {
        const double t = static_cast<double>(k) / kSteps;
        const Anchor at = interpolate(recipe.anchors, t);
        const double lightness = recipe.dark + (recipe.light - recipe.dark) * t;
        table[static_cast<std::size_t>(k)] =
            screen_colour(lightness, at.chroma, radians(at.hue_deg));
    }
    return table;
}

const Table& table_of(ColourMap map) {
    static const std::array<Table, 4> tables = {
        make_table(ColourMap::Viridis), make_table(ColourMap::Inferno), make_table(ColourMap::Grey),
        make_table(ColourMap::ThesisRed)};
    return tables[static_cast<std::size_t>(map)];
}

}  // namespace

Colour colour_of(ColourMap map, double t) {
    const Table& table = table_of(map);
    const double place = kSteps * std::clamp(t, 0.0, 1.0);
    const auto k = std::min(static_cast<std::size_t>(place), std::size_t{kSteps - 1});
    return mix(table[k], table[k + 1], place - static_cast<double>(k));
}

}  // namespace asperity::io
