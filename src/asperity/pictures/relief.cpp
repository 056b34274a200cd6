// SPDX-License-Identifier: Apache-2.0
#include <asperity/pictures/relief.h>

#include <cmath>

namespace asperity::io {

namespace {

constexpr int kCellsAreSeen = 8;  ///< pixels a cell from which facets are shown as facets

/// A height with its slope.
struct Sample {
    Slope slope;
    double height = 0;
};

class SmoothSurface {
  public:
    explicit SmoothSurface(const Heightfield& surface) : surface_(surface) {}

    /// At a place in cells from the first sample: bilinear between samples.
    Sample at(double x, double y) const {
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = x - i, v = y - j;
        const Sample a = sample(i, j), b = sample(i + 1, j), c = sample(i, j + 1),
                     d = sample(i + 1, j + 1);
        const auto between = [&](auto part) {
            return (1 - v) * ((1 - u) * part(a) + u * part(b)) +
                   v * ((1 - u) * part(c) + u * part(d));
        };
        return {{between([](const Sample& s) { return s.slope.x; }),
                 between([](const Sample& s) { return s.slope.y; })},
                between([](const Sample& s) { return s.height; })};
    }

  private:
    double height(int i, int j) const {
        const auto held = [&](int k, int count) {
            if (surface_.boundary == Boundary::Periodic) return (k % count + count) % count;
            return std::clamp(k, 0, count - 1);
        };
        return static_cast<double>(surface_.at(held(i, surface_.nx), held(j, surface_.ny)));
    }
    /// Between the neighbours on either side; one of them at an edge.
    Sample sample(int i, int j) const {
        const bool finite = surface_.boundary == Boundary::Finite;
        const double wide_x = finite && (i <= 0 || i >= surface_.nx - 1) ? 1 : 2;
        const double wide_y = finite && (j <= 0 || j >= surface_.ny - 1) ? 1 : 2;
        return {{(height(i + 1, j) - height(i - 1, j)) / (wide_x * surface_.dx),
                 (height(i, j + 1) - height(i, j - 1)) / (wide_y * surface_.dy)},
                height(i, j)};
    }

    const Heightfield& surface_;
};

}  // namespace

Canvas relief_of(const Heightfield& surface, const ReliefShading& shading) {
    const Zoom zoom(surface);
    if (zoom.pixels == 1 || zoom.pixels >= kCellsAreSeen)
        return draw_facets(surface, [&](const Heightfield& s, int i, int j, Triangle t) {
            const double middle =
                0.5 * (static_cast<double>(s.at(i + 1, j)) + static_cast<double>(s.at(i, j + 1)));
            return shading.colour(facet_slope(s, i, j, t), middle);
        });
    const SmoothSurface smooth(surface);
    Canvas canvas(zoom.picture(surface.cells_x()), zoom.picture(surface.cells_y()), {});
    parallel_for(static_cast<std::size_t>(canvas.height()), Run().threads(), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < canvas.width(); ++x) {
            const Sample at = smooth.at((x + 0.5) / zoom.pixels, (y + 0.5) / zoom.pixels);
            canvas.set(x, y, shading.colour(at.slope, at.height));
        }
    });
    return canvas;
}

}  // namespace asperity::io
