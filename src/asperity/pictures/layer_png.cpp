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
#include <filesystem>

namespace asperity::io {

namespace {

constexpr int kPictureWidth = 1000;  // about; a cell never gets less than a pixel

/// Size of the painted hemisphere: whole pixels a cell in a sky-map.
Rect painted_size(const Detector& detector, Projection projection) {
    if (projection == Projection::Disk) {
        const int diameter = std::max(880, detector.columns());
        return {0, 0, diameter, diameter};
    }
    const double exact = static_cast<double>(kPictureWidth) / detector.columns();
    const int at_least = detector.kind() == DetectorKind::EqualArea ? 2 : 1;
    const int cell = std::max(at_least, static_cast<int>(std::lround(exact)));
    const int width = cell * detector.columns();
    return {0, 0, width, std::max(cell * detector.rows(), width / 2)};
}

/// Where things stand in a picture with a legend; `unit` enlarges type and margins of big pictures.
struct Layout {
    double unit = 1;
    Rect hemisphere, bar;
    int width = 0, height = 0;
    Theme theme;

    Layout(const Detector& detector, const SkyMapSettings& settings)
        : hemisphere(painted_size(detector, settings.projection)), theme(theme_of(settings)) {
        unit = std::max(1.0, hemisphere.width / 1100.0);
        const bool disk = settings.projection == Projection::Disk;
        hemisphere.x = pixels(disk ? 66 : 64);
        hemisphere.y = pixels(disk ? 122 : 84);
        width = hemisphere.right() + pixels(disk ? 160 : 124);
        height = hemisphere.bottom() + pixels(disk ? 84 : 76);
        const int bar_height = disk ? hemisphere.height * 3 / 5 : hemisphere.height - pixels(44);
        const int bar_y = disk ? hemisphere.y + (hemisphere.height - bar_height) / 2 : hemisphere.y;
        bar = {hemisphere.right() + pixels(disk ? 60 : 26), bar_y, pixels(18), bar_height};
        theme.title *= unit, theme.body *= unit, theme.small *= unit;
    }
    int pixels(double at_unit_size) const {
        return static_cast<int>(std::lround(at_unit_size * unit));
    }
};

std::string title_of(const Measurement& m, const Layer& layer, const SkyMapSettings& settings) {
    std::string title = fmt::format("Layer {} · θᵢ {}", layer.number, degree_text(layer.theta_i));
    if (!m.experiment.illumination.isotropic && layer.phi_i != 0)
        title += fmt::format(" · φᵢ {}", degree_text(layer.phi_i));
    return title + fmt::format(" · albedo {:.3f}", shown_albedo(m, layer, settings.channel));
}

std::string subtitle_of(const Measurement& m, const Layer& layer, const SkyMapSettings& settings) {
    std::string text = fmt::format("{} · {} rays", m.surface_name, layer.rays);
    if (m.surface_name.empty()) text = fmt::format("{} rays", layer.rays);
    if (settings.channel >= 0)
        text += " · channel " + m.channel_names[static_cast<std::size_t>(settings.channel)];
    else if (m.channels() > 1)
        text += fmt::format(" · mean of {} channels", m.channels());
    return text;
}

void draw_sky_map_axes(Canvas& canvas, const Layout& layout) {
    const Rect area = layout.hemisphere;
    const TextStyle label{layout.theme.small, layout.theme.text};
    const TextStyle name{layout.theme.body, layout.theme.faint_text};
    const double unit = layout.unit;
    for (int phi = 0; phi <= 360; phi += 90) {
        const double x = area.x + area.width * (phi / 360.0);
        canvas.line({x, area.bottom() + 2.0}, {x, area.bottom() + 7 * unit}, unit,
                    layout.theme.faint_text);
        draw_text(canvas, {x, area.bottom() + 22 * unit}, fmt::format("{}°", phi), label,
                  Align::Centre);
    }
    for (int theta = 0; theta <= 90; theta += 30) {
        const double y = area.y + area.height * (theta / 90.0);
        canvas.line({area.x - 7 * unit, y}, {area.x - 2.0, y}, unit, layout.theme.faint_text);
        draw_text(canvas, {area.x - 11 * unit, y + 0.36 * label.size}, fmt::format("{}°", theta),
                  label, Align::Right);
    }
    draw_text(canvas, {area.centre().x, area.bottom() + 48 * unit}, "φₒ", name, Align::Centre);
    draw_text(canvas, {area.x - 44 * unit, area.centre().y + 5 * unit}, "θₒ", name, Align::Centre);
}

void draw_disk_axes(Canvas& canvas, const Layout& layout) {
    const Rect area = layout.hemisphere;
    const TextStyle label{layout.theme.small, layout.theme.text};
    const double r = 0.5 * area.width, unit = layout.unit;
    const Point c = area.centre();
    canvas.circle(c, r + 0.5, unit, layout.theme.frame);
    for (int phi = 0; phi < 360; phi += 30) {
        const double x = std::cos(radians(phi)), y = -std::sin(radians(phi));
        canvas.line({c.x + (r + 2) * x, c.y + (r + 2) * y},
                    {c.x + (r + 7 * unit) * x, c.y + (r + 7 * unit) * y}, unit,
                    layout.theme.faint_text);
        // Labels lie around the circle: those at the right begin, those at the left end there.
        const Align align = x > 0.1 ? Align::Left : x < -0.1 ? Align::Right : Align::Centre;
        const double reach = r + 12 * unit;
        const Point at = {c.x + reach * x, c.y + reach * y + label.size * (0.36 + 0.36 * y)};
        const std::string text = phi == 0 ? "φₒ 0°" : fmt::format("{}°", phi);
        draw_text(canvas, at, text, label, align);
    }
    for (const int theta : {30, 60}) {
        const Point at = place_of(radians(theta), radians(255), area, Projection::Disk);
        draw_text(canvas, {at.x + 1, at.y - 4 * unit + 1}, fmt::format("θₒ {}°", theta),
                  {label.size, {0, 0, 0}, 1.3}, Align::Centre);
        draw_text(canvas, {at.x, at.y - 4 * unit}, fmt::format("θₒ {}°", theta),
                  {label.size, {0.925, 0.933, 0.945}}, Align::Centre);
    }
}

/// What the ring and the dot mean, at the right end of the line below the picture.
void draw_key(Canvas& canvas, const Layout& layout) {
    const TextStyle style{layout.theme.small, layout.theme.faint_text};
    const double unit = layout.unit;
    const double y = layout.height - 24 * unit;
    double x = layout.hemisphere.right();
    for (const bool ring : {true, false}) {
        const char* text = ring ? "mirror direction" : "light";
        draw_text(canvas, {x, y}, text, style, Align::Right);
        x -= text_width(text, style.size) + 14 * unit;
        const Point mark = {x, y - 0.3 * style.size};
        if (ring)
            draw_ring(canvas, mark, 5 * unit);
        else
            draw_dot(canvas, mark, 6 * unit);
        x -= 24 * unit;
    }
}

void draw_legend(Canvas& canvas, const Layout& layout, const Measurement& m, const Layer& layer,
                 const ValueScale& scale, const SkyMapSettings& settings) {
    const Theme& theme = layout.theme;
    const Rect area = layout.hemisphere;
    const int left = layout.pixels(64);
    const double room = layout.width - left - layout.pixels(24);
    const std::string title = title_of(m, layer, settings);
    draw_text(canvas, {1.0 * left, 36 * layout.unit}, title,
              {fitting_size(title, theme.title, room), theme.text, 1.1});
    const std::string subtitle = subtitle_of(m, layer, settings);
    draw_text(canvas, {1.0 * left, 60 * layout.unit}, subtitle,
              {fitting_size(subtitle, theme.small, room), theme.faint_text});

    draw_grid(canvas, area, settings.projection, 0.16);
    draw_marks(canvas, area, layer, settings.projection, 6 * layout.unit);
    if (settings.projection == Projection::SkyMap) {
        canvas.frame(area, theme.frame);
        draw_sky_map_axes(canvas, layout);
    } else {
        draw_disk_axes(canvas, layout);
    }
    draw_text(canvas, {1.0 * layout.bar.x, layout.bar.y - 12 * layout.unit}, "f [1/sr]",
              {theme.body, theme.faint_text});
    draw_colour_bar(canvas, layout.bar, BarDirection::Upright, scale, settings.colour_map, theme);
    draw_key(canvas, layout);
}

/// "layer_15_theta_00", with the azimuth where one polar angle stands at several.
std::string file_name(const Measurement& m, const Layer& layer, int digits) {
    const auto angle = [](double radians_, int width) {
        const double value = std::round(degrees(radians_) * 100) / 100 + 0.0;
        const bool whole = value == std::round(value);
        return whole ? fmt::format("{:0{}.0f}", value, width)
                     : fmt::format("{:0{}.2f}", value, width + 3);
    };
    std::string name =
        fmt::format("layer_{:0{}}_theta_{}", layer.number, digits, angle(layer.theta_i, 2));
    if (m.experiment.illumination.phi_deg.size() > 1) name += "_phi_" + angle(layer.phi_i, 3);
    return name + ".png";
}

}  // namespace

void write_layer_png(const Measurement& measurement, const Layer& layer, const std::string& path,
                     const SkyMapSettings& settings) {
    check_settings(measurement, settings);
    const ValueScale scale = value_scale(measurement, {&layer}, settings);
    const Theme theme = theme_of(settings);
    if (!settings.legend) {
        const Rect area = painted_size(measurement.detector, settings.projection);
        Canvas canvas(area.width, area.height, theme.background);
        paint_layer(canvas, area, measurement, layer, scale, settings);
        write_png(canvas, path);
        return;
    }
    const Layout layout(measurement.detector, settings);
    Canvas canvas(layout.width, layout.height, theme.background);
    paint_layer(canvas, layout.hemisphere, measurement, layer, scale, settings);
    draw_legend(canvas, layout, measurement, layer, scale, settings);
    write_png(canvas, path);
}

std::vector<std::string> write_layer_pngs(const Measurement& measurement, const std::string& folder,
                                          const SkyMapSettings& settings) {
    check_settings(measurement, settings);
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error(ErrorCode::InputOutput,
                    fmt::format("cannot make the folder ({})", failure.message()), folder);
    int largest = 0;
    for (const Layer& layer : measurement.layers) largest = std::max(largest, layer.number);
    const int digits = std::max(2, static_cast<int>(std::to_string(largest).size()));
    std::vector<std::string> names;
    for (const Layer& layer : measurement.layers) {
        const auto path = std::filesystem::path(folder) / file_name(measurement, layer, digits);
        write_layer_png(measurement, layer, path.string(), settings);
        names.push_back(path.string());
    }
    return names;
}

}  // namespace asperity::io
