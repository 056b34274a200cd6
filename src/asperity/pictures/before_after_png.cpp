// SPDX-License-Identifier: Apache-2.0
// A topography as its file has it, beside the surface that was made of it.
#include <asperity/core/length.h>
#include <asperity/pictures/colour_map.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/stroke_font.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace asperity::io {

namespace {

constexpr int kSide = 620, kMargin = 36, kHead = 76, kFoot = 84;
constexpr ColourMap kMap = ColourMap::Viridis;

/// Heights over a grid, NaN where missing.
struct Panel {
    const char* title;
    int nx, ny;
    double dx, dy;
    std::string unit;
    std::vector<double> heights;
    double low = 0, high = 0;

    /// All heights but the most extreme thousandth on either side: a spike must not hide the rest.
    void find_range() {
        std::vector<double> measured;
        std::copy_if(heights.begin(), heights.end(), std::back_inserter(measured),
                     [](double h) { return !std::isnan(h); });
        if (measured.empty()) return;
        const auto spare = static_cast<std::ptrdiff_t>(measured.size() / 1000);
        std::nth_element(measured.begin(), measured.begin() + spare, measured.end());
        low = measured[static_cast<std::size_t>(spare)];
        std::nth_element(measured.begin(), measured.end() - 1 - spare, measured.end());
        high = measured[measured.size() - 1 - static_cast<std::size_t>(spare)];
    }
    double at(int i, int j) const {
        return heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) +
                       static_cast<std::size_t>(i)];
    }
    std::string length(double value) const {
        return unit == "m" ? length_text(value) : fmt::format("{:.4g} {}", value, unit);
    }
};

Panel panel_of(const Topography& t) {
    Panel panel{"as measured", t.nx, t.ny, t.dx, t.dy, t.unit, t.heights};
    for (std::size_t k = 0; k < t.missing.size(); ++k)
        if (t.missing[k] == 1) panel.heights[k] = std::numeric_limits<double>::quiet_NaN();
    panel.find_range();
    return panel;
}

Panel panel_of(const Heightfield& s) {
    Panel panel{"made ready", s.nx, s.ny, s.dx, s.dy, s.unit, {}};
    panel.heights.assign(s.heights.begin(), s.heights.end());
    panel.find_range();
    return panel;
}

/// The sample in the middle of each pixel; where nothing was measured, black.
void paint(Canvas& canvas, Rect area, const Panel& panel) {
    const double range = panel.high - panel.low;
    for (int y = 0; y < area.height; ++y)
        for (int x = 0; x < area.width; ++x) {
            const int i = static_cast<int>((x + 0.5) * panel.nx / area.width);
            const int j = static_cast<int>((y + 0.5) * panel.ny / area.height);
            const double h = panel.at(i, j);
            const double t = range > 0 ? std::clamp((h - panel.low) / range, 0.0, 1.0) : 0.5;
            canvas.set(area.x + x, area.y + y, std::isnan(h) ? kZeroColour : colour_of(kMap, t));
        }
}

void draw(Canvas& canvas, int left, const Panel& panel) {
    const Theme theme;
    const double width = panel.nx * panel.dx, height = panel.ny * panel.dy;
    const double scale = kSide / std::max(width, height);
    const Rect area = {left, kHead, std::max(1, static_cast<int>(std::lround(width * scale))),
                       std::max(1, static_cast<int>(std::lround(height * scale)))};
    draw_text(canvas, {1.0 * left, 36}, panel.title, {theme.title, theme.text, 1.05});
    draw_text(canvas, {1.0 * left, 60},
              fmt::format("{} × {} samples · {} × {}", panel.nx, panel.ny, panel.length(width),
                          panel.length(height)),
              {theme.body, theme.faint_text});
    paint(canvas, area, panel);
    canvas.frame(area, theme.frame);
    const Rect bar = {left, area.bottom() + 18, kSide, 14};
    for (int x = 0; x < bar.width; ++x)
        canvas.fill({bar.x + x, bar.y, 1, bar.height}, colour_of(kMap, (x + 0.5) / bar.width));
    canvas.frame(bar, theme.frame);
    const double y = bar.bottom() + 22.0;
    draw_text(canvas, {1.0 * bar.x, y}, panel.length(panel.low), {theme.small, theme.text});
    draw_text(canvas, {1.0 * bar.right(), y}, panel.length(panel.high), {theme.small, theme.text},
              Align::Right);
}

}  // namespace

void write_before_after_png(const Topography& before, const Heightfield& after,
                            const std::string& path) {
    const Panel panels[] = {panel_of(before), panel_of(after)};
    int height = 0;
    for (const Panel& p : panels)
        height = std::max(
            height,
            static_cast<int>(std::lround(kSide * std::min(1.0, p.ny * p.dy / (p.nx * p.dx)))));
    const Theme theme;
    Canvas canvas(2 * kSide + 3 * kMargin, kHead + std::max(height, 1) + kFoot, theme.background);
    draw(canvas, kMargin, panels[0]);
    draw(canvas, 2 * kMargin + kSide, panels[1]);
    write_png(canvas, path);
}

}  // namespace asperity::io
