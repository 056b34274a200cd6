// SPDX-License-Identifier: Apache-2.0
// What a plot is drawn on. The studio draws with Qt, files are written by Cairo; painters see only
// this.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::plots {

/// sRGB-encoded, in [0, 1]; `a` is the opacity.
struct Colour {
    double r = 0, g = 0, b = 0, a = 1;
    friend constexpr bool operator==(Colour, Colour) = default;
    constexpr Colour with_opacity(double opacity) const { return {r, g, b, opacity}; }
};

/// `a` at t = 0, `b` at t = 1.
constexpr Colour mix(Colour a, Colour b, double t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
            a.a + (b.a - a.a) * t};
}

/// A place [units of the canvas]: x to the right, y down. A unit is a CSS pixel, 1/96 inch, where
/// the canvas is a drawing.
struct Place {
    double x = 0, y = 0;
    friend constexpr bool operator==(Place, Place) = default;
    friend constexpr Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Place operator*(double s, Place a) { return {s * a.x, s * a.y}; }
};

struct Box {
    double left = 0, top = 0, width = 0, height = 0;
    constexpr double right() const { return left + width; }
    constexpr double bottom() const { return top + height; }
    constexpr Place centre() const { return {left + width / 2, top + height / 2}; }
    constexpr bool contains(Place p) const {
        return p.x >= left && p.x <= right() && p.y >= top && p.y <= bottom();
    }
};

struct Font {
    double size = 12;  ///< of the em square
    bool bold = false;
    friend constexpr bool operator==(Font, Font) = default;
};

/// How a line is drawn. `dashes`: lengths of dashes and gaps in turn; with them ends are flat,
/// without them round.
struct Stroke {
    Colour colour;
    double width = 1;
    std::vector<double> dashes = {};
};

/// Where a text stands about its place, across; upright it is the middle of its line.
enum class TextAlign { Left, Centre, Right };

/// Pixels, rows from the top: alpha, red, green, blue from the highest byte down, colours
/// multiplied by alpha.
struct Raster {
    int width = 0, height = 0;
    std::vector<std::uint32_t> argb;

    Raster() = default;
    Raster(int columns, int rows);
    std::uint32_t& at(int x, int y) { return argb[offset(x, y)]; }
    std::uint32_t at(int x, int y) const { return argb[offset(x, y)]; }

  private:
    std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};
std::uint32_t packed(Colour colour);

/// How wide and high texts are, with the type of a canvas. Const and thread-safe.
class TextMeasure {
  public:
    virtual ~TextMeasure() = default;
    virtual double width(std::string_view text, Font font) const = 0;
    virtual double height(Font font) const = 0;  ///< from the lowest to the highest letters
};

/// Smooth lines, areas, words and pictures in a plane of units.
class Canvas {
  public:
    virtual ~Canvas() = default;
    virtual void polyline(std::span<const Place> points, const Stroke& stroke) = 0;
    /// Closed; where it covers itself it is filled once.
    virtual void polygon(std::span<const Place> points, Colour fill) = 0;
    /// An arc from one angle to another, counter-clockwise from the right [rad].
    virtual void arc(Place centre, double radius, double from, double to, const Stroke& stroke) = 0;
    virtual void disc(Place centre, double radius, Colour fill) = 0;
    /// `turn`: counter-clockwise about the place [degrees].
    virtual void text(Place place, std::string_view text, Font font, Colour colour, TextAlign align,
                      double turn = 0) = 0;
    /// Stretched over `box`, smoothly.
    virtual void picture(const Box& box, const Raster& raster) = 0;
    /// What is drawn between push and pop is cut off at the box.
    virtual void push_clip(const Box& box) = 0;
    virtual void pop_clip() = 0;
    /// Pixels of a picture that a unit deserves.
    virtual double pixels_per_unit() const = 0;

    // Made of the above
    void line(Place from, Place to, const Stroke& stroke);
    void fill(const Box& box, Colour colour);
    void frame(const Box& box, const Stroke& stroke);
    void circle(Place centre, double radius, const Stroke& stroke);
};

}  // namespace asperity::plots
