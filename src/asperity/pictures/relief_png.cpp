// SPDX-License-Identifier: Apache-2.0
// The relief of a surface with what a reader needs: its name, a scale bar, a key of the heights.
#include <asperity/core/length.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/relief.h>
#include <asperity/pictures/stroke_font.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::io {

namespace {

constexpr int kReliefMargin = 28, kReliefFoot = 76, kLeastWidth = 420;

std::string length(const Heightfield& surface, double value) {
    return surface.unit == "m" ? length_text(value)
                               : fmt::format("{:.4g} {}s", value, surface.unit);
}

/// The largest 1, 2 or 5 times a power of ten that is no longer than `most`.
double round_down(double most) {
    const double decade = std::pow(10.0, std::floor(std::log10(most)));
    for (const double step : {5.0, 2.0})
        if (step * decade <= most * (1 + 1e-9)) return step * decade;
    return decade;
}

void draw_scale_bar(Canvas& canvas, Point left, const Heightfield& surface, double pixels,
                    const Theme& theme) {
    const double of_picture = surface.dx * surface.cells_x();
    const double shown = round_down(of_picture / 4);
    const double width = pixels * shown / of_picture;
    canvas.fill({static_cast<int>(left.x), static_cast<int>(left.y),
                 static_cast<int>(std::lround(width)), 5},
                theme.text);
    draw_text(canvas, {left.x + width / 2, left.y + 28}, length(surface, shown),
              {theme.body, theme.text}, Align::Centre);
}

/// Colours of level places, from the lowest tint to the highest.
void draw_key(Canvas& canvas, Rect bar, const Heightfield& surface, const ReliefShading& shading,
              const Theme& theme) {
    for (int x = 0; x < bar.width; ++x) {
        const double t = 2 * (x + 0.5) / bar.width - 1;
        canvas.fill({bar.x + x, bar.y, 1, bar.height},
                    shading.colour({}, shading.mean() + t * shading.reach()));
    }
    canvas.frame(bar, theme.frame);
    const double y = bar.bottom() + 20.0;
    const TextStyle style{theme.small, theme.text};
    const std::string reach = surface.unit == "m"
                                  ? length_text(shading.reach())
                                  : fmt::format("{:.3g} {}s", shading.reach(), surface.unit);
    draw_text(canvas, {1.0 * bar.x, y}, "≤ −" + reach, style);
    draw_text(canvas, {bar.centre().x, y}, "mean height", {theme.small, theme.faint_text},
              Align::Centre);
    draw_text(canvas, {1.0 * bar.right(), y}, "≥ +" + reach, style, Align::Right);
}

}  // namespace

void write_relief_png(const Heightfield& surface, const std::string& path, bool dark) {
    validate(surface, path);
    const Theme theme = dark ? Theme{} : light_theme();
    const ReliefShading shading(surface);
    const Canvas relief = relief_of(surface, shading);
    const int width = std::max(relief.width(), kLeastWidth);
    const std::vector<std::string> title =
        wrapped(surface.name.empty() ? "surface" : surface.name, theme.title, width);
    const int head = kReliefMargin + static_cast<int>(title.size()) * 26 + 30;
    Canvas canvas(width + 2 * kReliefMargin, head + relief.height() + kReliefFoot,
                  theme.background);
    double y = kReliefMargin + 16.0;
    for (const std::string& line : title) {
        draw_text(canvas, {1.0 * kReliefMargin, y}, line, {theme.title, theme.text, 1.05});
        y += 26;
    }
    draw_text(canvas, {1.0 * kReliefMargin, y},
              fmt::format("{} × {} samples · {} × {}", surface.nx, surface.ny,
                          length(surface, surface.dx * surface.cells_x()),
                          length(surface, surface.dy * surface.cells_y())),
              {theme.body, theme.faint_text});
    for (int row = 0; row < relief.height(); ++row)
        for (int x = 0; x < relief.width(); ++x)
            canvas.set(kReliefMargin + x, head + row, relief.get(x, row));
    canvas.frame({kReliefMargin, head, relief.width(), relief.height()}, theme.frame);
    const double foot = head + relief.height() + 20.0;
    draw_scale_bar(canvas, {1.0 * kReliefMargin, foot}, surface, relief.width(), theme);
    const int key = std::min(320, width / 2);
    draw_key(canvas, {kReliefMargin + width - key, static_cast<int>(foot) - 4, key, 14}, surface,
             shading, theme);
    write_png(canvas, path);
}

}  // namespace asperity::io
