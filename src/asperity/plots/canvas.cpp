// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/canvas.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

Raster::Raster(int columns, int rows)
    : width(columns),
      height(rows),
      argb(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}

std::uint32_t packed(Colour colour) {
    const auto byte = [](double value) {
        return static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    };
    const double a = std::clamp(colour.a, 0.0, 1.0);
    return byte(a) << 24 | byte(a * colour.r) << 16 | byte(a * colour.g) << 8 | byte(a * colour.b);
}

void Canvas::line(Place from, Place to, const Stroke& stroke) {
    polyline(std::array{from, to}, stroke);
}

void Canvas::fill(const Box& box, Colour colour) {
    polygon(std::array<Place, 4>{{{box.left, box.top},
                                  {box.right(), box.top},
                                  {box.right(), box.bottom()},
                                  {box.left, box.bottom()}}},
            colour);
}

void Canvas::frame(const Box& box, const Stroke& stroke) {
    polyline(std::array<Place, 5>{{{box.left, box.top},
                                   {box.right(), box.top},
                                   {box.right(), box.bottom()},
                                   {box.left, box.bottom()},
                                   {box.left, box.top}}},
             stroke);
}

void Canvas::circle(Place centre, double radius, const Stroke& stroke) {
    arc(centre, radius, 0, 2 * kPi, stroke);
}

}  // namespace asperity::plots
