// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/pictures/layer_view.h>
#include <asperity/pictures/legend.h>
#include <asperity/pictures/pictures.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/stroke_font.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {

namespace {

constexpr int kSheetWidth = 1600;
constexpr int kSmallestTile = 48;  // narrower tiles make the sheet wider instead

/// Tiles in rows and columns, each a picture with its title below.
struct SheetLayout {
    int columns = 1, rows = 1;
    Rect tile;  ///< size of the picture within a tile
    int gap_x = 36, gap_y = 0;
    int margin = 64, header = 0, footer = 0;
    int width = 0, height = 0;
    bool legend = true, details = true;  ///< details: the second line of a title fits

    SheetLayout(int count, const SkyMapSettings& settings) : legend(settings.legend) {
        const bool disk = settings.projection == Projection::Disk;
        columns = columns_for(count, disk);
        rows = (count + columns - 1) / columns;
        if (columns > 8) gap_x = 12;
        const int room = kSheetWidth - 2 * margin - (columns - 1) * gap_x;
        const int side = std::clamp(room / columns, kSmallestTile, disk ? 640 : 960);
        tile = {0, 0, side, disk ? side : side / 2};
        details = side >= 180;
        const int title = details ? 48 : 22;
        gap_y = legend ? title + (details ? 30 : 10) : gap_x;
        header = legend ? 150 : margin;
        footer = legend ? 68 : margin - gap_y;
        width = std::max(kSheetWidth, 2 * margin + columns * side + (columns - 1) * gap_x);
        height = header + rows * (tile.height + gap_y) + footer;
    }

    /// The picture of tile number k; an unfinished last row stands at the left.
    Rect tile_at(int k) const {
        const int left = (width - columns * tile.width - (columns - 1) * gap_x) / 2;
        return {left + (k % columns) * (tile.width + gap_x),
                header + (k / columns) * (tile.height + gap_y), tile.width, tile.height};
    }

  private:
    /// Columns for tiles of this shape: three rows of five for the thesis' 15 layers as disks. Few
    /// empty places count more than a sheet of exactly the shape wanted.
    static int columns_for(int count, bool disk) {
        const double shape = disk ? 1.6 : 0.6;  // columns / rows wanted
        const int wanted = std::max(1, static_cast<int>(std::lround(std::sqrt(shape * count))));
        const auto badness = [&](int c) {
            const int empty = (count + c - 1) / c * c - count;
            return empty + std::abs(c - wanted);
        };
        int best = wanted;
        for (int c = std::max(1, wanted - 3); c <= std::min(count, wanted + 3); ++c)
            if (badness(c) <= badness(best)) best = c;
        return best;
    }
};

std::string angles_text(const Measurement& m, const Layer& layer) {
    std::string text = "θᵢ " + degree_text(layer.theta_i);
    if (m.experiment.illumination.phi_deg.size() > 1) text += " · φᵢ " + degree_text(layer.phi_i);
    return text;
}

std::string details_of(const Measurement& m, const Layer& layer, const ValueScale& scale,
                       const SkyMapSettings& settings) {
    const std::string text = fmt::format("layer {} · albedo {:.3f}", layer.number,
                                         shown_albedo(m, layer, settings.channel));
    if (!settings.own_scales) return text;
    ValueScale whole = scale;
    whole.clipped = false;
    return text + " · up to " + ticks_of(whole).back().label + "/sr" +
           (scale.clipped ? " and more" : "");
}

void draw_tile(Canvas& canvas, Rect area, const SheetLayout& layout, const Measurement& m,
               const Layer& layer, const ValueScale& scale, const SkyMapSettings& settings) {
    const Theme theme = theme_of(settings);
    paint_layer(canvas, area, m, layer, scale, settings);
    if (!layout.legend) return;
    if (layout.details) {
        draw_grid(canvas, area, settings.projection, 0.14);
        draw_marks(canvas, area, layer, settings.projection, 4);
    }
    if (settings.projection == Projection::Disk)
        canvas.circle(area.centre(), 0.5 * area.width + 0.5, 1, theme.frame);
    else
        canvas.frame(area, theme.frame);

    const double x = area.centre().x;
    if (!layout.details) {
        draw_text(canvas, {x, area.bottom() + 18.0}, degree_text(layer.theta_i), {12, theme.text},
                  Align::Centre);
        return;
    }
    draw_text(canvas, {x, area.bottom() + 27.0}, angles_text(m, layer), {17, theme.text, 1.05},
              Align::Centre);
    draw_text(canvas, {x, area.bottom() + 47.0}, details_of(m, layer, scale, settings),
              {theme.small, theme.faint_text}, Align::Centre);
}

/// The scale of the header: that of all pictures, or, when each has its own, shares of those.
ValueScale header_scale(const ValueScale& scale, const SkyMapSettings& settings) {
    if (!settings.own_scales) return scale;
    ValueScale shares = scale;
    shares.high = 1;
    shares.low = settings.scale == Scale::Log ? std::pow(10.0, -settings.decades) : 0;
    return shares;
}

void draw_header(Canvas& canvas, const SheetLayout& layout, const Measurement& m,
                 const ValueScale& scale, const SkyMapSettings& settings) {
    const Theme theme = theme_of(settings);
    const int bar_width = 470;
    const Rect bar = {layout.width - layout.margin - bar_width, 58, bar_width, 18};
    const double room = bar.x - 2.0 * layout.margin - 40;
    const std::string title = m.surface_name.empty() ? "BRDF" : m.surface_name;
    draw_text(canvas, {1.0 * layout.margin, 66}, title,
              {fitting_size(title, 26, room), theme.text, 1.05});

    double rays = 0;
    for (const Layer& layer : m.layers) rays += static_cast<double>(layer.rays);
    std::string line = fmt::format("{} {} of incidence · {:.3g} million rays", m.layers.size(),
                                   m.layers.size() == 1 ? "direction" : "directions", rays / 1e6);
    if (m.surface_nx > 0)
        line = fmt::format("{} x {} heights · ", m.surface_nx, m.surface_ny) + line;
    if (settings.channel >= 0)
        line += " · channel " + m.channel_names[static_cast<std::size_t>(settings.channel)];
    else if (m.channels() > 1)
        line += fmt::format(" · mean of {} channels", m.channels());
    draw_text(canvas, {1.0 * layout.margin, 94}, line,
              {fitting_size(line, 15, room), theme.faint_text});

    draw_text(canvas, {1.0 * bar.x, bar.y - 12.0},
              settings.own_scales ? "BRDF f, share of what each picture ends at" : "BRDF f [1/sr]",
              {theme.body, theme.faint_text});
    draw_colour_bar(canvas, bar, BarDirection::Lying, header_scale(scale, settings),
                    settings.colour_map, theme);
}

void draw_footer(Canvas& canvas, const SheetLayout& layout, const SkyMapSettings& settings) {
    const Theme theme = theme_of(settings);
    const TextStyle style{theme.small, theme.faint_text};
    const double y = layout.height - 34.0;
    std::string reading = settings.projection == Projection::Disk
                              ? "The hemisphere seen from above: radius sin θₒ, φₒ from the "
                                "right, counter-clockwise"
                              : "Across: φₒ 0° to 360°; down: θₒ 0° to 90°";
    if (layout.details)
        reading += settings.projection == Projection::Disk
                       ? "; circles at θₒ 30° and 60°"
                       : "; lines at φₒ 90°, 180°, 270° and θₒ 30°, 60°";
    draw_text(canvas, {1.0 * layout.margin, y}, reading, style);
    if (!layout.details) return;
    double x = layout.width - layout.margin;
    for (const bool ring : {true, false}) {
        const char* text = ring ? "mirror direction" : "light";
        draw_text(canvas, {x, y}, text, style, Align::Right);
        x -= text_width(text, style.size) + 13;
        if (ring)
            draw_ring(canvas, {x, y - 4}, 4);
        else
            draw_dot(canvas, {x, y - 4}, 5);
        x -= 22;
    }
}

}  // namespace

void write_layer_sheet(const Measurement& measurement, const std::string& path,
                       const SkyMapSettings& settings) {
    check_settings(measurement, settings);
    if (measurement.layers.empty())
        throw Error(ErrorCode::Usage, "there is no layer to draw", path);
    std::vector<const Layer*> layers;
    for (const Layer& layer : measurement.layers) layers.push_back(&layer);
    const ValueScale scale = value_scale(measurement, layers, settings);
    const SheetLayout layout(static_cast<int>(layers.size()), settings);
    Canvas canvas(layout.width, layout.height, theme_of(settings).background);
    for (std::size_t k = 0; k < layers.size(); ++k)
        draw_tile(canvas, layout.tile_at(static_cast<int>(k)), layout, measurement, *layers[k],
                  settings.own_scales ? value_scale(measurement, {layers[k]}, settings) : scale,
                  settings);
    if (settings.legend) {
        draw_header(canvas, layout, measurement, scale, settings);
        draw_footer(canvas, layout, settings);
    }
    write_png(canvas, path);
}

}  // namespace asperity::io
