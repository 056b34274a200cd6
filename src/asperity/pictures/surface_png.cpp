// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/pictures/canvas.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity::io {

namespace {

constexpr int kLongestSide = 1024;  // of the picture [pixels], about

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

/// Thesis look (its figures 2.10 to 2.12): red = |n_x|, green = |n_up|, blue = |n_z|, where the
/// thesis' z axis is our -y. A flat surface is pure green.
Colour normal_colour(Slope slope) {
    const Vec3 n = normal_of(slope);
    return {std::abs(n.x), n.z, std::abs(n.y)};
}

/// Lights the relief from the upper left and tints it by height, cool below and warm above.
class Shading {
  public:
    explicit Shading(const Heightfield& surface) {
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
Triangle triangle_at(Diagonal diagonal, double u, double v) {
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
Canvas draw(const Heightfield& surface, const FacetColour& facet_colour) {
    const Zoom zoom(surface);
    Canvas canvas(zoom.picture(surface.cells_x()), zoom.picture(surface.cells_y()), {});
    parallel_for(static_cast<std::size_t>(canvas.height()), Run().threads(), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < canvas.width(); ++x)
            canvas.set(x, y, pixel_colour(surface, zoom, x, y, facet_colour));
    });
    return canvas;
}

}  // namespace

void write_surface_png(const Heightfield& surface, const std::string& path, SurfaceLook look) {
    validate(surface, path);
    if (look == SurfaceLook::Normals) {
        const auto colour = [](const Heightfield& s, int i, int j, Triangle t) {
            return normal_colour(facet_slope(s, i, j, t));
        };
        write_png(draw(surface, colour), path);
        return;
    }
    const Shading shading(surface);
    const auto colour = [&](const Heightfield& s, int i, int j, Triangle t) {
        const double middle =
            0.5 * (static_cast<double>(s.at(i + 1, j)) + static_cast<double>(s.at(i, j + 1)));
        return shading.colour(facet_slope(s, i, j, t), middle);
    };
    write_png(draw(surface, colour), path);
}

}  // namespace asperity::io
