// SPDX-License-Identifier: Apache-2.0
// A topography as its file has it, beside the surface that was made of it.
#include <asperity/pictures/colour_map.h>
#include <asperity/pictures/height_map.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/stroke_font.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {

namespace {

constexpr int kSide = 620, kMargin = 36, kHead = 76, kFoot = 84;
constexpr ColourMap kMap = ColourMap::Viridis;

struct Panel {
    const char* title;
    HeightMap map;
};

/// Where nothing was measured, black.
void paint(Canvas& canvas, Rect area, const HeightMap& map) {
    for (int y = 0; y < area.height; ++y)
        for (int x = 0; x < area.width; ++x) {
            const float h =
                map.heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(area.width) +
                            static_cast<std::size_t>(x)];
            canvas.set(area.x + x, area.y + y,
                       std::isnan(h) ? kZeroColour : colour_of(kMap, map.position(h)));
        }
}

void draw(Canvas& canvas, int left, const Panel& panel) {
    const Theme theme;
    const HeightMap& map = panel.map;
    const Rect area = {left, kHead, map.width, map.height};
    draw_text(canvas, {1.0 * left, 36}, panel.title, {theme.title, theme.text, 1.05});
    draw_text(canvas, {1.0 * left, 60}, map.caption(), {theme.body, theme.faint_text});
    paint(canvas, area, map);
    canvas.frame(area, theme.frame);
    const Rect bar = {left, area.bottom() + 18, kSide, 14};
    for (int x = 0; x < bar.width; ++x)
        canvas.fill({bar.x + x, bar.y, 1, bar.height}, colour_of(kMap, (x + 0.5) / bar.width));
    canvas.frame(bar, theme.frame);
    const double y = bar.bottom() + 22.0;
    draw_text(canvas, {1.0 * bar.x, y}, map.length(map.low), {theme.small, theme.text});
    draw_text(canvas, {1.0 * bar.right(), y}, map.length(map.high), {theme.small, theme.text},
              Align::Right);
}

}  // namespace

void write_before_after_png(const Topography& before, const Heightfield& after,
                            const std::string& path) {
    const Panel panels[] = {{"as measured", height_map(before, kSide)},
                            {"made ready", height_map(after, kSide)}};
    const int height = std::max(panels[0].map.height, panels[1].map.height);
    const Theme theme;
    Canvas canvas(2 * kSide + 3 * kMargin, kHead + height + kFoot, theme.background);
    draw(canvas, kMargin, panels[0]);
    draw(canvas, 2 * kMargin + kSide, panels[1]);
    write_png(canvas, path);
}

}  // namespace asperity::io
