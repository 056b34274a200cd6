// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/stroke_font.h>

#include <asperity/core/directions.h>
#include <asperity/pictures/glyph_table.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace asperity::io {

namespace {

constexpr double kCapital = 10, kSmallLetter = 7;
constexpr double kCapitalShare = 0.72;  ///< height of a capital / size of the text
constexpr double kStrokeShare = 0.094;  ///< width of a stroke / size of the text

double bearing(char side) {
    switch (side) {
        case 's':
            return 1.7;
        case 'r':
            return 1.3;
        case 'd':
            return 0.8;
        default:
            return 0.0;
    }
}

void append_arc(Polyline& line, std::istream& pen) {
    double cx = 0, cy = 0, rx = 0, ry = 0, from = 0, to = 0;
    pen >> cx >> cy >> rx >> ry >> from >> to;
    const int steps = std::max(2, static_cast<int>(std::abs(to - from) / 12));
    for (int k = 0; k <= steps; ++k) {
        const double angle = radians(from + (to - from) * k / steps);
        line.push_back({cx + rx * std::cos(angle), cy + ry * std::sin(angle)});
    }
}

Glyph draw(const GlyphSource& source) {
    Glyph glyph{source.width, bearing(source.sides[0]), bearing(source.sides[1]), {}};
    std::istringstream pen(source.pen);
    bool lifted = true;
    for (char command = 0; pen >> command;) {
        if (command == 'C') {
            if (lifted) glyph.lines.emplace_back();
            append_arc(glyph.lines.back(), pen);
            lifted = false;
            continue;
        }
        Point p;
        pen >> p.x >> p.y;
        if (command == 'L') {
            glyph.lines.back().push_back(p);
        } else {  // M or D: a new line begins here; a dot is a line of one point
            glyph.lines.push_back({p});
        }
        lifted = command == 'D';
    }
    return glyph;
}

Glyph shrink(const Glyph& base, double rise) {
    Glyph glyph{base.width * kSmall, base.left * kSmall + 0.5, base.right * kSmall, base.lines};
    for (Polyline& line : glyph.lines)
        for (Point& p : line) p = {p.x * kSmall, p.y * kSmall + rise};
    return glyph;
}

const std::map<char32_t, Glyph>& glyphs() {
    static const std::map<char32_t, Glyph> all = [] {
        std::map<char32_t, Glyph> made;
        for (const GlyphSource& source : kGlyphSources) made.emplace(source.code, draw(source));
        for (const SmallGlyphSource& source : kSmallGlyphSources)
            made.emplace(source.code, shrink(made.at(source.base), source.rise));
        return made;
    }();
    return all;
}

/// Takes the next code point off UTF-8 `text`; a broken sequence gives one unknown sign a byte.
char32_t next_code(std::string_view& text) {
    const auto byte_at = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char lead = byte_at(0);
    const std::size_t length = lead < 0x80             ? 1
                               : (lead & 0xE0) == 0xC0 ? 2
                               : (lead & 0xF0) == 0xE0 ? 3
                               : (lead & 0xF8) == 0xF0 ? 4
                                                       : 0;
    bool whole = length > 0 && length <= text.size();
    for (std::size_t k = 1; whole && k < length; ++k) whole = (byte_at(k) & 0xC0) == 0x80;
    if (!whole) {
        text.remove_prefix(1);
        return U'\uFFFD';
    }
    char32_t code = length == 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) code = (code << 6) | (byte_at(k) & 0x3Fu);
    text.remove_prefix(length);
    return code;
}

/// Fits letters to the pixel grid: stems and bars of regular width then stay sharp.
struct Hinting {
    double unit, capital, small_letter;  ///< pixels a unit, heights of the letters [pixels]

    explicit Hinting(double size)
        : unit(size * kCapitalShare / kCapital),
          capital(std::round(unit * kCapital)),
          small_letter(std::round(unit * kSmallLetter)) {}

    /// Height above the baseline [pixels]; straight between the heights of the letters.
    double y(double units) const {
        if (units <= 0) return units * unit;
        if (units <= kSmallLetter) return units * small_letter / kSmallLetter;
        return small_letter +
               (units - kSmallLetter) * (capital - small_letter) / (kCapital - kSmallLetter);
    }
    double advance(const Glyph& g) const { return std::round((g.left + g.width + g.right) * unit); }
    /// Pixels a unit, across: a glyph is a whole number of pixels wide.
    double across(const Glyph& g) const {
        return g.width > 0 ? std::round(g.width * unit) / g.width : unit;
    }
};

/// The lines of a glyph on the canvas; `origin` is where its left side bearing begins. Bars and
/// stems, straight along an axis, are moved to the nearest centre of a pixel row or column.
std::vector<Polyline> place(const Glyph& glyph, Point origin, const Hinting& hinting) {
    const double left = origin.x + std::round(glyph.left * hinting.unit) + 0.5;
    const double baseline = std::round(origin.y) - 0.5;
    const double across = hinting.across(glyph);
    std::vector<Polyline> placed = glyph.lines;
    for (std::size_t n = 0; n < placed.size(); ++n) {
        const Polyline& drawn = glyph.lines[n];
        Polyline& line = placed[n];
        for (std::size_t k = 0; k < drawn.size(); ++k)
            line[k] = {left + drawn[k].x * across, baseline - hinting.y(drawn[k].y)};
        const auto to_centre = [](double v) { return std::floor(v) + 0.5; };
        for (std::size_t k = 1; k < drawn.size(); ++k) {
            Point &a = line[k - 1], &b = line[k];
            if (std::abs(drawn[k - 1].y - drawn[k].y) < 1e-9) a.y = b.y = to_centre(b.y);
            if (std::abs(drawn[k - 1].x - drawn[k].x) < 1e-9) a.x = b.x = to_centre(b.x);
        }
    }
    return placed;
}

}  // namespace

bool has_glyph(char32_t code) {
    return glyphs().contains(code);
}

const Glyph& glyph_of(char32_t code) {
    static const Glyph unknown = draw({U'\0', 5, "rr", "M 0 0 L 5 0 L 5 10 L 0 10 L 0 0"});
    const auto found = glyphs().find(code);
    return found == glyphs().end() ? unknown : found->second;
}

double text_width(std::string_view text, double size) {
    const Hinting hinting(size);
    double width = 0;
    while (!text.empty()) width += hinting.advance(glyph_of(next_code(text)));
    return width;
}

void draw_text(Canvas& canvas, Point at, std::string_view text, const TextStyle& style,
               Align align) {
    const Hinting hinting(style.size);
    const double width = text_width(text, style.size);
    const double share = align == Align::Left ? 0.0 : align == Align::Centre ? 0.5 : 1.0;
    Point origin = {std::round(at.x - share * width), at.y};
    while (!text.empty()) {
        const Glyph& glyph = glyph_of(next_code(text));
        canvas.stroke(place(glyph, origin, hinting), style.size * kStrokeShare * style.weight,
                      style.colour);
        origin.x += hinting.advance(glyph);
    }
}

std::vector<std::string> wrapped(std::string_view text, double size, double width) {
    std::vector<std::string> lines;
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word;) {
        if (!lines.empty() && text_width(lines.back() + ' ' + word, size) <= width)
            lines.back() += ' ' + word;
        else
            lines.push_back(word);
    }
    return lines;
}

double fitting_size(std::string_view text, double size, double width) {
    const double needed = text_width(text, size);
    return needed > width && width > 0 ? size * width / needed : size;
}

}  // namespace asperity::io
