// SPDX-License-Identifier: Apache-2.0
// Surfaces seen from above, facet by facet or as a smooth relief; inside this folder only.
#pragma once

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/pictures/canvas.h>
#include <asperity/surface/heightfield.h>

#include <algorithm>

namespace asperity::io {

inline constexpr int kLongestSide = 1024;  ///< of the picture [pixels], about

/// Cells a pixel, or pixels a cell: one of the two is 1.
struct Zoom {
    int cells = 1, pixels = 1;

    explicit Zoom(const Heightfield& surface) {
        const int side = std::max(surface.cells_x(), surface.cells_y());
        cells = (side + kLongestSide - 1) / kLongestSide;
        pixels = std::max(1, kLongestSide / side);
    }
    int picture(int cells_on_side) const { return (cells_on_side + cells - 1) / cells * pixels; }
};

/// Lights the relief from the upper left and tints it by height, cool below and warm above.
class ReliefShading {
  public:
    explicit ReliefShading(const Heightfield& surface) {
        double sum = 0, squares = 0;
        for (const float h : surface.heights) sum += static_cast<double>(h);
        mean_ = sum / static_cast<double>(surface.heights.size());
        for (const float h : surface.heights)
            squares += (static_cast<double>(h) - mean_) * (static_cast<double>(h) - mean_);
        spread_ = std::sqrt(squares / static_cast<double>(surface.heights.size()));
        relief_ = relief_of(surface);
    }

    Colour colour(Slope slope, double height) const {
        // Towards the light; rows count downwards, so up in the picture is -y.
        const Vec3 light = normalize({-0.5, -0.62, 0.75});
        const Vec3 n = normal_of({relief_ * slope.x, relief_ * slope.y});
        const double lit = std::max(0.0, dot(n, light));
        const double open = 0.5 + 0.5 * n.z;  // share of the sky a tilted facet sees
        const double level =
            spread_ > 0 ? std::clamp(0.5 + (height - mean_) / (5 * spread_), 0.0, 1.0) : 0.5;
        const Colour tint = mix({0.46, 0.56, 0.70}, {1.00, 0.95, 0.86}, level);
        const double hollow = 0.62 + 0.38 * level;  // deep places see less of the sky
        const double brightness = hollow * (0.24 * open + 0.96 * lit);
        return {tint.r * brightness, tint.g * brightness, tint.b * brightness};
    }

    double mean() const { return mean_; }
    /// Heights so far from the mean have the coldest and the warmest tint.
    double reach() const { return 2.5 * spread_; }

  private:
    /// Factor on the slopes that brings gentle and steep surfaces to a relief the eye reads well.
    static double relief_of(const Heightfield& surface) {
        constexpr double kGentle = 0.4, kSteep = 0.9;
        constexpr int kProbes = 256;  // cells looked at along each side, at most
        double squares = 0, count = 0;
        const int step_x = 1 + surface.cells_x() / kProbes,
                  step_y = 1 + surface.cells_y() / kProbes;
        for (int j = 0; j < surface.cells_y(); j += step_y) {
            for (int i = 0; i < surface.cells_x(); i += step_x) {
                const Slope s = facet_slope(surface, i, j, Triangle::Lower);
                squares += s.x * s.x + s.y * s.y;
                count += 1;
            }
        }
        const double rms = std::sqrt(squares / count);
        return rms > 0 ? std::clamp(rms, kGentle, kSteep) / rms : 1.0;
    }

    double mean_ = 0, spread_ = 0, relief_ = 1;
};

/// The triangle of a cell below the point (u, v) in [0, 1) x [0, 1) of it.
inline Triangle triangle_at(Diagonal diagonal, double u, double v) {
    const bool lower = diagonal == Diagonal::Anti ? u + v < 1 : v < u;
    return lower ? Triangle::Lower : Triangle::Upper;
}

template <typename FacetColour>
Colour cell_mean(const Heightfield& surface, int i, int j, const FacetColour& facet_colour) {
    return mix(facet_colour(surface, i, j, Triangle::Lower),
               facet_colour(surface, i, j, Triangle::Upper), 0.5);
}

/// Colour of pixel (x, y): of the facet seen there, or the mean of all facets it covers.
template <typename FacetColour>
Colour pixel_colour(const Heightfield& surface, Zoom zoom, int x, int y,
                    const FacetColour& facet_colour) {
    if (zoom.pixels > 1) {
        const double u = (x % zoom.pixels + 0.5) / zoom.pixels;
        const double v = (y % zoom.pixels + 0.5) / zoom.pixels;
        return facet_colour(surface, x / zoom.pixels, y / zoom.pixels,
                            triangle_at(surface.diagonal, u, v));
    }
    const int i1 = std::min((x + 1) * zoom.cells, surface.cells_x());
    const int j1 = std::min((y + 1) * zoom.cells, surface.cells_y());
    Colour sum;
    double count = 0;
    for (int j = y * zoom.cells; j < j1; ++j) {
        for (int i = x * zoom.cells; i < i1; ++i) {
            const Colour c = cell_mean(surface, i, j, facet_colour);
            sum = {sum.r + c.r, sum.g + c.g, sum.b + c.b};
            count += 1;
        }
    }
    return {sum.r / count, sum.g / count, sum.b / count};
}

template <typename FacetColour>
Canvas draw_facets(const Heightfield& surface, const FacetColour& facet_colour) {
    const Zoom zoom(surface);
    Canvas canvas(zoom.picture(surface.cells_x()), zoom.picture(surface.cells_y()), {});
    parallel_for(static_cast<std::size_t>(canvas.height()), Run().threads(), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < canvas.width(); ++x)
            canvas.set(x, y, pixel_colour(surface, zoom, x, y, facet_colour));
    });
    return canvas;
}

/// The surface as light shows it. Where a cell has a few pixels, slopes run smoothly from sample to
/// sample: facets of two pixels would look like a weave that no surface has. Larger ones are seen
/// as they are.
Canvas relief_of(const Heightfield& surface, const ReliefShading& shading);

}  // namespace asperity::io
