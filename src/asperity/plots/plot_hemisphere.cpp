// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_hemisphere.h>

#include <asperity/core/directions.h>
#include <asperity/plots/plot_curves.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

constexpr Colour kBlack = {0, 0, 0}, kWhite = {1, 1, 1};

/// A line that is seen on any colour: light on a dark rim.
template <class Paint>
void paint_outlined(double width, const Paint& paint) {
    paint(Stroke{kBlack, 2.2 * width});
    paint(Stroke{kWhite, width});
}

/// Directions are told in degrees.
std::string direction_text(double theta, double phi) {
    return fmt::format("θₒ = {:.1f}°   φₒ = {:.1f}°", degrees(theta), degrees(phi));
}

double standard_error(const Measurement& head, const Layer& layer, int channel, int cell) {
    if (channel >= 0) return head.brdf_stderr(layer, channel, cell);
    double sum = 0;  // channels share their rays
    for (int c = 0; c < head.channels(); ++c) sum += head.brdf_stderr(layer, c, cell);
    return sum / head.channels();
}

}  // namespace

HemisphereValues hemisphere_values(const Measurement& measurement, const Layer& layer,
                                   int channel) {
    HemisphereValues values;
    values.detector = measurement.detector;
    values.values = io::values_of(measurement, layer, channel);
    values.theta_i = layer.theta_i;
    values.phi_i = layer.phi_i;
    if (layer.stderr_energy.empty()) return values;
    for (int cell = 0; cell < values.detector.cells(); ++cell)
        values.errors.push_back(standard_error(measurement, layer, channel, cell));
    return values;
}

struct HemispherePlot::Layout {
    int columns = 1;
    double side = 2, step_x = 0, step_y = 0;
    Place first;  ///< left upper corner of the first disc
    Box bar;
};

HemispherePlot::HemispherePlot(Data data) : data_(std::move(data)), images_(data_.discs.size()) {
    if (!data_.painter) data_.painter = std::make_shared<DiscPainter>();
}

HemispherePlot::Layout HemispherePlot::layout(const Box& area, const PlotStyle& style) const {
    const Box rest = below_heading(area, style, {data_.title, data_.note});
    const double line = style.line_height();
    const double for_bar = 7.5 * line, across = 2 * 2.4 * line;
    const int count = static_cast<int>(data_.discs.size());
    const double upright = (count > 1 ? 4.2 : 2.9) * line;
    Layout best;
    for (int columns = 1; columns <= count; ++columns) {
        const int rows = (count + columns - 1) / columns;
        const double side = std::max(
            2.0, std::min((rest.width - for_bar) / columns - across, rest.height / rows - upright));
        if (columns > 1 && side <= best.side) continue;
        best.columns = columns;
        best.side = side;
        best.step_x = side + across;
        best.step_y = side + upright;
        const double wide = columns * best.step_x + for_bar, high = rows * best.step_y;
        best.first = {rest.left + (rest.width - wide) / 2 + across / 2,
                      rest.top + (rest.height - high) / 2 + 1.45 * line};
        const double bar_height = std::min(0.9 * (high - upright), 1.4 * side);
        best.bar = {rest.left + (rest.width + wide) / 2 - for_bar + 0.9 * line,
                    best.first.y + (high - upright - bar_height) / 2 + 0.4 * line, line,
                    bar_height};
    }
    return best;
}

Box HemispherePlot::disc(const Box& area, const PlotStyle& style, std::size_t k) const {
    const Layout at = layout(area, style);
    const int column = static_cast<int>(k) % at.columns, row = static_cast<int>(k) / at.columns;
    return {at.first.x + column * at.step_x, at.first.y + row * at.step_y, at.side, at.side};
}

Place HemispherePlot::place_of(const Box& disc, double theta, double phi) {
    const double r = 0.5 * disc.width * std::sin(theta);
    return disc.centre() + Place{r * std::cos(phi), -r * std::sin(phi)};
}

double HemispherePlot::height_for(double width, const PlotStyle& style) const {
    const double line = style.line_height();
    const double head = below_heading({0, 0, width, 0}, style, {data_.title, data_.note}).top;
    const int count = static_cast<int>(data_.discs.size());
    const int columns = count <= 3 ? count : (count + 1) / 2;
    const int rows = (count + columns - 1) / columns;
    const double side = (width - 7.5 * line) / columns - 4.8 * line;
    return head + rows * (std::max(side, 4 * line) + (count > 1 ? 4.2 : 2.9) * line);
}

void HemispherePlot::paint(Canvas& canvas, const Box& area, const PlotStyle& style) const {
    paint_heading(canvas, area, style, {data_.title, data_.note});
    for (std::size_t k = 0; k < data_.discs.size(); ++k) {
        const Box disc = this->disc(area, style, k);
        canvas.picture(
            disc, image(k, static_cast<int>(std::ceil(disc.width * canvas.pixels_per_unit()))));
        paint_grid(canvas, disc, style);
        paint_marks(canvas, disc, data_.discs[k]);
        if (k == 0 && data_.cell) paint_cell(canvas, disc);
        if (data_.discs.size() > 1)
            canvas.text({disc.centre().x, disc.bottom() + 2 * style.line_height()},
                        data_.discs[k].name, style.font, style.text, TextAlign::Centre);
    }
    paint_bar(canvas, layout(area, style).bar, style);
}

const Raster& HemispherePlot::image(std::size_t k, int pixels) const {
    if (images_[k].width != pixels)
        images_[k] = data_.painter->paint(pixels, data_.discs[k].detector, data_.discs[k].values,
                                          data_.scale, data_.colour_map);
    return images_[k];
}

void HemispherePlot::paint_grid(Canvas& canvas, const Box& disc, const PlotStyle& style) const {
    const double line = style.line_height();
    const Stroke faint{kWhite.with_opacity(0.24), 1};
    for (const double theta_deg : {30.0, 60.0})
        canvas.circle(disc.centre(), 0.5 * disc.width * std::sin(radians(theta_deg)), faint);
    canvas.line(place_of(disc, kPi / 2, 0), place_of(disc, kPi / 2, kPi), faint);
    canvas.line(place_of(disc, kPi / 2, kPi / 2), place_of(disc, kPi / 2, -kPi / 2), faint);
    canvas.circle(disc.centre(), 0.5 * disc.width, {style.faint, 1});
    for (int phi = 0; phi < 360; phi += 90) {
        const double reach = 0.5 * disc.width + (phi % 180 == 0 ? 0.4 : 0.75) * line;
        const Place along{std::cos(radians(phi)), -std::sin(radians(phi))};
        const TextAlign align = phi == 0     ? TextAlign::Left
                                : phi == 180 ? TextAlign::Right
                                             : TextAlign::Centre;
        canvas.text(disc.centre() + reach * along, fmt::format("{}°", phi), style.small,
                    style.faint, align);
    }
}

void HemispherePlot::paint_marks(Canvas& canvas, const Box& disc,
                                 const HemisphereValues& values) const {
    const double size = std::max(4.0, 0.018 * disc.width);
    // The mirror direction: a ring; the light: a small sun
    const Place mirror = place_of(disc, values.theta_i, values.phi_i + kPi);
    paint_outlined(1.3, [&](const Stroke& stroke) { canvas.circle(mirror, size, stroke); });
    if (values.theta_i == 0) return;
    const Place light = place_of(disc, values.theta_i, values.phi_i);
    paint_outlined(1.3, [&](const Stroke& stroke) {
        for (int k = 0; k < 8; ++k) {
            const Place along{std::cos(k * kPi / 4), std::sin(k * kPi / 4)};
            canvas.line(light + 0.55 * size * along, light + 1.1 * size * along, stroke);
        }
    });
}

void HemispherePlot::paint_cell(Canvas& canvas, const Box& disc) const {
    const Detector& detector = data_.discs.front().detector;
    if (*data_.cell < 0 || *data_.cell >= detector.cells()) return;
    const int row = *data_.cell / detector.columns(), column = *data_.cell % detector.columns();
    constexpr int kSteps = 12;
    std::vector<Place> outline;
    const auto add = [&](double theta, int step) {
        const double share = static_cast<double>(step) / kSteps;
        outline.push_back(
            place_of(disc, theta,
                     detector.phi_edge(column) +
                         share * (detector.phi_edge(column + 1) - detector.phi_edge(column))));
    };
    for (int step = 0; step <= kSteps; ++step) add(detector.theta_edge(row), step);
    for (int step = kSteps; step >= 0; --step) add(detector.theta_edge(row + 1), step);
    outline.push_back(outline.front());
    paint_outlined(1.5, [&](const Stroke& stroke) { canvas.polyline(outline, stroke); });
}

void HemispherePlot::paint_bar(Canvas& canvas, const Box& bar, const PlotStyle& style) const {
    paint_colour_bar(canvas, bar, style, data_.scale, data_.colour_map, "BRDF  f  [sr⁻¹]");
}

void paint_colour_bar(Canvas& canvas, const Box& bar, const PlotStyle& style,
                      const io::ValueScale& scale, io::ColourMap map, const std::string& name) {
    const double line = style.line_height();
    constexpr int kSteps = 256;
    Raster colours(1, kSteps);
    for (int k = 0; k < kSteps; ++k) {
        const io::Colour c = io::colour_of(map, 1 - (k + 0.5) / kSteps);
        colours.at(0, k) = packed({c.r, c.g, c.b});
    }
    canvas.picture(bar, colours);
    canvas.frame(bar, {style.faint, 1});
    const PlotAxis axis{{}, scale.low, scale.high, scale.scale == io::Scale::Log, 0};
    const double end = bar.right() + 0.5 * line;
    for (const PlotTick& tick :
         axis.ticks(std::max(2, static_cast<int>(bar.height / (1.8 * line))))) {
        const double y = bar.bottom() - axis.position(tick.value) * bar.height;
        const double length = (tick.label.empty() ? 0.15 : 0.3) * line;
        canvas.line({bar.right(), y}, {bar.right() + length, y}, {style.faint, 1});
        if (y > bar.top + 1.1 * line)
            canvas.text({end, y}, tick.label, style.small, style.faint, TextAlign::Left);
    }
    // The upper end is always told: cells may lie above it
    canvas.line({bar.right(), bar.top}, {bar.right() + 0.3 * line, bar.top}, {style.faint, 1});
    canvas.text({end, bar.top}, (scale.clipped ? "≥ " : "") + value_text(scale.high), style.small,
                style.faint, TextAlign::Left);
    canvas.text({bar.left - 0.3 * line, bar.top - 1.15 * line}, name, style.font, style.text,
                TextAlign::Left);
}

std::optional<PlotReading> HemispherePlot::reading(Place place, const Box& area,
                                                   const PlotStyle& style) const {
    for (std::size_t k = 0; k < data_.discs.size(); ++k) {
        const Box disc = this->disc(area, style, k);
        const HemisphereValues& of = data_.discs[k];
        const double x = (place.x - disc.centre().x) / (0.5 * disc.width);
        const double y = (disc.centre().y - place.y) / (0.5 * disc.width);
        const double r2 = x * x + y * y;
        if (r2 >= 1) continue;
        const int cell = of.detector.cell_of({x, y, std::sqrt(1 - r2)});
        const std::size_t at = static_cast<std::size_t>(cell);
        PlotReading reading;
        reading.cell = cell;
        reading.text = fmt::format(
            "cell {}   {}   f = {} ± {} sr⁻¹", cell,
            direction_text(of.detector.theta_centre(cell / of.detector.columns()),
                           of.detector.phi_centre(cell % of.detector.columns())),
            value_text(of.values[at]), error_text(of.errors.empty() ? 0 : of.errors[at]));
        return reading;
    }
    return std::nullopt;
}

PlotTable HemispherePlot::table() const {
    PlotTable table;
    const auto same = [](const Detector& a, const Detector& b) {
        return a.kind() == b.kind() && a.rows() == b.rows() && a.columns() == b.columns();
    };
    for (std::size_t k = 0; k < data_.discs.size(); ++k) {
        const HemisphereValues& of = data_.discs[k];
        const Detector& detector = of.detector;
        const bool own = k == 0 || !same(detector, data_.discs.front().detector);
        const std::string prefix = data_.discs.size() == 1 ? "" : of.name + ": ";
        std::vector<double> cells, theta, phi;
        for (int cell = 0; cell < detector.cells(); ++cell) {
            cells.push_back(cell);
            theta.push_back(degrees(detector.theta_centre(cell / detector.columns())));
            phi.push_back(degrees(detector.phi_centre(cell % detector.columns())));
        }
        if (own) {
            const std::string whose = k == 0 ? "" : prefix;
            table.columns.push_back({whose + "cell", cells});
            table.columns.push_back({whose + "theta_o [deg]", theta});
            table.columns.push_back({whose + "phi_o [deg]", phi});
        }
        table.columns.push_back({prefix + "f [1/sr]", of.values});
        if (!of.errors.empty())
            table.columns.push_back({prefix + "standard error of f [1/sr]", of.errors});
    }
    return table;
}

}  // namespace asperity::plots
