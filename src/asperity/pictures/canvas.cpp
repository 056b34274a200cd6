// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/canvas.h>

#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace asperity::io {

namespace {

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(255 * std::clamp(value, 0.0, 1.0) + 0.5);
}

double from_byte(std::uint8_t value) {
    return value / 255.0;
}

/// Distance from `p` to the straight stroke from `a` to `b`.
double distance(Point p, Point a, Point b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double length2 = dx * dx + dy * dy;
    const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
    const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

double distance(Point p, const std::vector<Polyline>& lines) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Polyline& line : lines) {
        if (line.size() == 1) nearest = std::min(nearest, distance(p, line[0], line[0]));
        for (std::size_t k = 1; k < line.size(); ++k)
            nearest = std::min(nearest, distance(p, line[k - 1], line[k]));
    }
    return nearest;
}

/// How much of a pixel lies inside an edge that passes `inside` pixels beyond its centre.
double coverage(double inside) {
    return std::clamp(inside + 0.5, 0.0, 1.0);
}

}  // namespace

Canvas::Canvas(int width, int height, Colour background)
    : width_(std::max(1, width)), height_(std::max(1, height)) {
    try {
        bytes_.resize(offset(0, height_));
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory,
                    fmt::format("no memory for a picture of {} x {} pixels", width_, height_));
    }
    fill({0, 0, width_, height_}, background);
}

void Canvas::set(int x, int y, Colour colour) {
    std::uint8_t* pixel = &bytes_[offset(x, y)];
    pixel[0] = to_byte(colour.r);
    pixel[1] = to_byte(colour.g);
    pixel[2] = to_byte(colour.b);
}

Colour Canvas::get(int x, int y) const {
    const std::uint8_t* pixel = &bytes_[offset(x, y)];
    return {from_byte(pixel[0]), from_byte(pixel[1]), from_byte(pixel[2])};
}

void Canvas::blend(int x, int y, Colour colour, double opacity) {
    if (opacity > 0) set(x, y, mix(get(x, y), colour, opacity));
}

Rect Canvas::clipped(double left, double top, double right, double bottom) const {
    const auto pixel = [](double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    const int x0 = pixel(std::floor(left), width_), x1 = pixel(std::ceil(right), width_);
    const int y0 = pixel(std::floor(top), height_), y1 = pixel(std::ceil(bottom), height_);
    return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

void Canvas::fill(Rect area, Colour colour) {
    const Rect box = clipped(area.x, area.y, area.right(), area.bottom());
    for (int y = box.y; y < box.bottom(); ++y)
        for (int x = box.x; x < box.right(); ++x) set(x, y, colour);
}

void Canvas::stroke(const std::vector<Polyline>& lines, double width, Colour colour,
                    double opacity) {
    double left = width_, right = 0, top = height_, bottom = 0;
    for (const Polyline& line : lines) {
        for (const Point p : line) {
            left = std::min(left, p.x), right = std::max(right, p.x);
            top = std::min(top, p.y), bottom = std::max(bottom, p.y);
        }
    }
    const double reach = 0.5 * width + 1;
    const Rect box = clipped(left - reach, top - reach, right + reach, bottom + reach);
    for (int y = box.y; y < box.bottom(); ++y) {
        for (int x = box.x; x < box.right(); ++x) {
            const double away = distance({x + 0.5, y + 0.5}, lines);
            // A stroke thinner than a pixel keeps a pixel's width and pales instead.
            const double shown = std::max(width, 1.0);
            blend(x, y, colour, opacity * std::min(width, 1.0) * coverage(0.5 * shown - away));
        }
    }
}

void Canvas::line(Point from, Point to, double width, Colour colour, double opacity) {
    stroke({{from, to}}, width, colour, opacity);
}

void Canvas::circle(Point centre, double radius, double width, Colour colour, double opacity) {
    const double reach = radius + 0.5 * width + 1;
    const Rect box =
        clipped(centre.x - reach, centre.y - reach, centre.x + reach, centre.y + reach);
    for (int y = box.y; y < box.bottom(); ++y) {
        for (int x = box.x; x < box.right(); ++x) {
            const double r = std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y);
            blend(x, y, colour, opacity * coverage(0.5 * width - std::abs(r - radius)));
        }
    }
}

void Canvas::disc(Point centre, double radius, Colour colour, double opacity) {
    const double reach = radius + 1;
    const Rect box =
        clipped(centre.x - reach, centre.y - reach, centre.x + reach, centre.y + reach);
    for (int y = box.y; y < box.bottom(); ++y) {
        for (int x = box.x; x < box.right(); ++x) {
            const double r = std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y);
            blend(x, y, colour, opacity * coverage(radius - r));
        }
    }
}

void Canvas::frame(Rect area, Colour colour) {
    fill({area.x - 1, area.y - 1, area.width + 2, 1}, colour);
    fill({area.x - 1, area.bottom(), area.width + 2, 1}, colour);
    fill({area.x - 1, area.y, 1, area.height}, colour);
    fill({area.right(), area.y, 1, area.height}, colour);
}

}  // namespace asperity::io
