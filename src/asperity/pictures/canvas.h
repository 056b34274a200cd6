// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity::io {

/// A colour as screens show it: sRGB-encoded red, green and blue in [0, 1].
struct Colour {
    double r = 0, g = 0, b = 0;
    friend constexpr bool operator==(Colour a, Colour b) = default;
};

/// `a` at t = 0, `b` at t = 1, straight between them in sRGB.
constexpr Colour mix(Colour a, Colour b, double t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

/// A place on a canvas [pixels]: x to the right, y down; pixel (i, j) covers [i, i+1) x [j, j+1).
struct Point {
    double x = 0, y = 0;
};

/// A chain of straight strokes; a single point is a dot.
using Polyline = std::vector<Point>;

/// A rectangle of whole pixels.
struct Rect {
    int x = 0, y = 0, width = 0, height = 0;
    int right() const { return x + width; }
    int bottom() const { return y + height; }
    Point centre() const { return {x + 0.5 * width, y + 0.5 * height}; }
};

/// An 8-bit RGB picture that lines, circles and text can be drawn on, with smooth edges. What lies
/// outside the picture is left out.
class Canvas {
  public:
    /// `width`, `height` >= 1. Throws Error(OutOfMemory).
    Canvas(int width, int height, Colour background);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Rows from the top, three bytes a pixel.
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

    /// Sets one pixel, which must lie inside. Threads may set different pixels at a time.
    void set(int x, int y, Colour colour);
    Colour get(int x, int y) const;
    /// Lays `colour` over a pixel, `opacity` in [0, 1].
    void blend(int x, int y, Colour colour, double opacity);

    void fill(Rect area, Colour colour);
    /// Strokes all `lines` as one shape with round ends: where they cross, nothing is drawn twice.
    void stroke(const std::vector<Polyline>& lines, double width, Colour colour,
                double opacity = 1);
    void line(Point from, Point to, double width, Colour colour, double opacity = 1);
    void circle(Point centre, double radius, double width, Colour colour, double opacity = 1);
    void disc(Point centre, double radius, Colour colour, double opacity = 1);
    /// A one-pixel frame just outside `area`.
    void frame(Rect area, Colour colour);

  private:
    std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x));
    }
    Rect clipped(double left, double top, double right, double bottom) const;

    int width_, height_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace asperity::io
