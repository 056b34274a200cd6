// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/residual_sheet.h>
#include <asperity/pictures/stroke_font.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::io {
namespace {

constexpr int kSide = 280, kGap = 28, kTitle = 62, kMargin = 56, kHeader = 130, kFooter = 50;
constexpr int kMostColumns = 5, kFewestColumns = 3;
constexpr int kBarWidth = 360;
constexpr Colour kLess = {0.27, 0.55, 0.98}, kEqual = {0.24, 0.25, 0.28}, kMore = {1.0, 0.58, 0.16};

void paint(Canvas& canvas, Rect area, const Detector& detector, const ResidualTile& tile) {
    for (int j = 0; j < area.height; ++j)
        for (int i = 0; i < area.width; ++i) {
            const double x = 2 * (i + 0.5) / area.width - 1, y = 1 - 2 * (j + 0.5) / area.height;
            const double r2 = x * x + y * y;
            if (r2 >= 1) continue;
            const auto cell = static_cast<std::size_t>(detector.cell_of({x, y, std::sqrt(1 - r2)}));
            if (std::isnan(tile.data[cell])) continue;
            canvas.set(area.x + i, area.y + j, residual_colour(tile.model[cell], tile.data[cell]));
        }
}

void draw_tile(Canvas& canvas, Rect area, const Detector& detector, const ResidualTile& tile) {
    const Theme theme;
    paint(canvas, area, detector, tile);
    draw_grid(canvas, area, Projection::Disk, 0.14);
    draw_ring(canvas, place_of(tile.theta_i, tile.phi_i + kPi, area, Projection::Disk), 4);
    draw_dot(canvas, place_of(tile.theta_i, tile.phi_i, area, Projection::Disk), 4);
    canvas.circle(area.centre(), 0.5 * area.width + 0.5, 1, theme.frame);
    draw_text(canvas, {area.centre().x, area.bottom() + 25.0}, "θᵢ " + degree_text(tile.theta_i),
              {16, theme.text, 1.05}, Align::Centre);
    draw_text(canvas, {area.centre().x, area.bottom() + 45.0}, tile.note,
              {theme.small, theme.faint_text}, Align::Centre);
}

void draw_scale(Canvas& canvas, Rect bar) {
    const Theme theme;
    for (int i = 0; i < bar.width; ++i) {
        const Colour colour = residual_colour(std::exp2(2.0 * i / (bar.width - 1) - 1), 1);
        canvas.fill({bar.x + i, bar.y, 1, bar.height}, colour);
    }
    canvas.frame(bar, theme.frame);
    constexpr std::array kTicks = {"1/2", "1", "2"};
    for (std::size_t k = 0; k < kTicks.size(); ++k)
        draw_text(canvas, {bar.x + 0.5 * static_cast<double>(k) * bar.width, bar.bottom() + 18.0},
                  kTicks[k], {theme.small, theme.text}, Align::Centre);
    draw_text(canvas, {1.0 * bar.x, bar.y - 10.0}, "model / data", {theme.body, theme.faint_text});
}

}  // namespace

Colour residual_colour(double model, double data) {
    if (model == data) return kEqual;
    const double octaves = data > 0 && model > 0 ? std::clamp(std::log2(model / data), -1.0, 1.0)
                                                 : (model > data ? 1.0 : -1.0);
    return octaves < 0 ? mix(kEqual, kLess, -octaves) : mix(kEqual, kMore, octaves);
}

void write_residual_sheet(const Detector& detector, const std::vector<ResidualTile>& tiles,
                          const std::string& title, const std::string& line,
                          const std::string& path) {
    if (tiles.empty()) throw Error(ErrorCode::Usage, "there is no layer to draw", path);
    const int count = static_cast<int>(tiles.size());
    const int columns = std::clamp(count, kFewestColumns, kMostColumns);
    const int rows = (count + columns - 1) / columns;
    const int width = 2 * kMargin + columns * kSide + (columns - 1) * kGap;
    const Theme theme;
    Canvas canvas(width, kHeader + rows * (kSide + kTitle) + kFooter, theme.background);
    for (int k = 0; k < count; ++k)
        draw_tile(canvas,
                  {kMargin + k % columns * (kSide + kGap), kHeader + k / columns * (kSide + kTitle),
                   kSide, kSide},
                  detector, tiles[static_cast<std::size_t>(k)]);
    const Rect bar = {width - kMargin - kBarWidth, 46, kBarWidth, 16};
    const double room = bar.x - 2.0 * kMargin;
    draw_text(canvas, {1.0 * kMargin, 56}, title,
              {fitting_size(title, 24, room), theme.text, 1.05});
    draw_text(canvas, {1.0 * kMargin, 84}, line, {fitting_size(line, 15, room), theme.faint_text});
    draw_scale(canvas, bar);
    draw_text(canvas, {1.0 * kMargin, canvas.height() - 22.0},
              "The hemisphere seen from above, means of f cos θ over blocks of cells; ring: mirror "
              "direction, dot: light",
              {theme.small, theme.faint_text});
    write_png(canvas, path);
}

}  // namespace asperity::io
