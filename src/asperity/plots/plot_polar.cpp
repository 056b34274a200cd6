// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_polar.h>

#include <asperity/core/directions.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

// Room about the disc, in lines: for the angles, and for the values and their name
constexpr double kAbove = 1.5, kBelow = 2.7, kBeside = 2.7;

double distance(const Box& box, Place from) {
    const double x = std::clamp(from.x, box.left, box.right());
    const double y = std::clamp(from.y, box.top, box.bottom());
    return std::hypot(x - from.x, y - from.y);
}

}  // namespace

PolarFrame::PolarFrame(Place centre, double radius, PlotAxis axis, const PlotStyle& style)
    : axis_(std::move(axis)), style_(style), centre_(centre), radius_(radius) {}

Place PolarFrame::on_circle(double theta_deg, double radius) const {
    const double theta = radians(theta_deg);
    return centre_ + radius * Place{std::sin(theta), -std::cos(theta)};
}

Place PolarFrame::map(double theta_deg, double value) const {
    return on_circle(theta_deg, radius_ * std::clamp(axis_.position(value), 0.0, 1.0));
}

std::optional<double> PolarFrame::theta_at(Place place) const {
    const Place from_centre = place - centre_;
    const double distance = std::hypot(from_centre.x, from_centre.y);
    if (from_centre.y > 0 || distance > radius_ || distance == 0) return std::nullopt;
    return degrees(std::atan2(from_centre.x, -from_centre.y));
}

void PolarFrame::paint_angles(Canvas& canvas) const {
    const double line = style_.line_height();
    for (int theta = -90; theta <= 90; theta += 10) {
        const bool labelled = theta % 30 == 0;
        const double from = labelled ? 0 : radius_ - 0.3 * line;
        canvas.line(on_circle(theta, from), on_circle(theta, radius_),
                    {labelled ? style_.grid : style_.faint, 1});
        if (!labelled) continue;
        const TextAlign align = theta < -45  ? TextAlign::Right
                                : theta > 45 ? TextAlign::Left
                                             : TextAlign::Centre;
        const double beyond = (align == TextAlign::Centre ? 0.85 : 0.45) * line;
        canvas.text(on_circle(theta, radius_ + beyond), number_label(theta, 30) + "°", style_.small,
                    style_.faint, align);
    }
}

void PolarFrame::paint_rings(Canvas& canvas) const {
    const double line = style_.line_height();
    double last_label = -1e9;
    for (const PlotTick& tick : axis_.ticks(std::max(2, static_cast<int>(radius_ / (3 * line))))) {
        const double r = radius_ * axis_.position(tick.value);
        const bool labelled = !tick.label.empty();
        if (r > 0.5 && labelled) canvas.arc(centre_, r, 0, kPi, {style_.grid, 1});
        for (const double side : {-1.0, 1.0}) {
            const Place foot = centre_ + Place{side * r, 0};
            canvas.line(foot, foot - Place{0, (labelled ? 0.3 : 0.15) * line}, {style_.faint, 1});
        }
        if (!labelled || r - last_label < style_.width_of(tick.label)) continue;
        last_label = r;
        for (const double side : {-1.0, 1.0}) {
            if (r < 0.5 && side < 0) continue;
            canvas.text(centre_ + Place{side * r, 0.75 * line}, tick.label, style_.small,
                        style_.faint, TextAlign::Centre);
        }
    }
}

void PolarFrame::paint_axes(Canvas& canvas) const {
    paint_angles(canvas);
    paint_rings(canvas);
    // The surface and the rim
    canvas.arc(centre_, radius_, 0, kPi, {style_.faint, 1});
    canvas.line(on_circle(-90, radius_), on_circle(90, radius_), {style_.faint, 1});
    canvas.text(centre_ + Place{0, 2 * style_.line_height()}, axis_.label, style_.font, style_.text,
                TextAlign::Centre);
}

void PolarFrame::paint_line(Canvas& canvas, const PlotCurve& curve) const {
    std::vector<Place> line;
    for (std::size_t k = 0; k < curve.x.size(); ++k) line.push_back(map(curve.x[k], curve.y[k]));
    canvas.polyline(line, stroke_of(style_, curve.ink, curve.look));
}

void PolarFrame::paint_band(Canvas& canvas, const PlotCurve& curve) const {
    asperity::plots::paint_band(canvas, style_, curve, 0.25,
                                [this](double x, double y) { return map(x, y); });
}

void PolarFrame::paint_light(Canvas& canvas, double theta_deg) const {
    const double line = style_.line_height(), head = 0.75 * line;
    const Colour colour = style_.ink(PlotInk::Light);
    canvas.line(on_circle(theta_deg, radius_), on_circle(theta_deg, 0.8 * head),
                {colour, line / 8});
    const Place along = on_circle(theta_deg, 1) - centre_;
    const Place across{-along.y, along.x};
    canvas.polygon(std::array{centre_, centre_ + head * along + 0.32 * head * across,
                              centre_ + head * along - 0.32 * head * across},
                   colour);
}

void PolarFrame::paint_direction(Canvas& canvas, double theta_deg, const Stroke& stroke) const {
    canvas.line(centre_, on_circle(theta_deg, radius_), stroke);
}

PolarPlot::PolarPlot(CurveSet set, PlotAxis radius, std::vector<double> theta_i_deg)
    : set_(std::move(set)), axis_(std::move(radius)), theta_i_deg_(std::move(theta_i_deg)) {}

Heading PolarPlot::heading() const {
    Heading heading{set_.title, set_.note_with(axis_.high), legend_of(set_)};
    if (!theta_i_deg_.empty()) {
        heading.legend.push_back({"light", PlotInk::Light, CurveLook::Line});
        heading.legend.push_back({"mirror direction", PlotInk::Mirror, CurveLook::Dashes});
    }
    return heading;
}

PolarPlot::Layout PolarPlot::legend_above(const Box& area, const PlotStyle& style) const {
    const double line = style.line_height();
    const Box rest = below_heading(area, style, heading());
    Layout layout;
    layout.radius = std::max(
        1.0, std::min(rest.width / 2 - kBeside * line, rest.height - (kAbove + kBelow) * line));
    const double spare = rest.height - (kAbove + kBelow) * line - layout.radius;
    layout.centre = {rest.centre().x,
                     rest.top + kAbove * line + std::max(0.0, spare) / 2 + layout.radius};
    layout.entries =
        placed_entries(heading().legend, area, style, below_lines(area, style, heading()));
    return layout;
}

PolarPlot::Layout PolarPlot::legend_in_corners(const Box& area, const PlotStyle& style) const {
    const double line = style.line_height();
    const Heading heading = this->heading();
    Layout layout;
    // Curves on the left below each other, light and mirror direction on the right
    const double top = below_lines(area, style, heading);
    double left_y = top + 0.6 * line, right_y = top + 0.6 * line;
    std::vector<Box> taken;
    for (const PlacedLine& words : placed_lines(area, style, heading)) taken.push_back(words.box);
    const std::size_t curves = set_.curves.size();
    for (std::size_t k = 0; k < heading.legend.size(); ++k) {
        const LegendEntry& entry = heading.legend[k];
        const double width = box_of({entry, {}}, style).width;
        double& y = k < curves ? left_y : right_y;
        const double x = k < curves ? area.left + 0.5 * line : area.right() - 0.5 * line - width;
        layout.entries.push_back({entry, {x, y}});
        taken.push_back(box_of(layout.entries.back(), style));
        y += 1.15 * line;
    }
    const double bottom = area.bottom() - kBelow * line;
    const auto fits = [&](double radius) {
        const Place centre{area.centre().x, bottom};
        return std::all_of(taken.begin(), taken.end(), [&](const Box& box) {
            return distance(box, centre) >= radius + kAbove * line;
        });
    };
    double low = 1, high = std::max(1.0, std::min(area.width / 2 - kBeside * line,
                                                  area.height - (kAbove + kBelow) * line));
    if (!fits(high)) {
        for (int step = 0; step < 30; ++step) {
            const double middle = (low + high) / 2;
            (fits(middle) ? low : high) = middle;
        }
        high = low;
    }
    layout.radius = high;
    layout.centre = {area.centre().x, bottom};
    return layout;
}

PolarPlot::Layout PolarPlot::layout(const Box& area, const PlotStyle& style) const {
    Layout above = legend_above(area, style), corners = legend_in_corners(area, style);
    return corners.radius > 1.02 * above.radius ? corners : above;
}

double PolarPlot::height_for(double width, const PlotStyle& style) const {
    // As high as it may be used: with the words above, or in the corners
    const double line = style.line_height();
    const double disc = width / 2 + (kAbove + kBelow - kBeside) * line;
    const Box tall{0, 0, width, 10 * width};
    const double above = below_heading(tall, style, heading()).top + disc;
    for (double height = disc; height < above; height += 0.5 * line) {
        const Layout layout = legend_in_corners({0, 0, width, height}, style);
        if (layout.radius >= width / 2 - kBeside * line - 1e-6) return height;
    }
    return above;
}

PolarFrame PolarPlot::frame(const Box& area, const PlotStyle& style) const {
    const Layout layout = this->layout(area, style);
    return {layout.centre, layout.radius, axis_, style};
}

void PolarPlot::paint(Canvas& canvas, const Box& area, const PlotStyle& style) const {
    canvas.fill(area, style.paper);
    const Layout layout = this->layout(area, style);
    paint_lines(canvas, style, placed_lines(area, style, heading()));
    for (const PlacedEntry& entry : layout.entries) paint_entry(canvas, style, entry);
    const PolarFrame frame(layout.centre, layout.radius, axis_, style);
    frame.paint_axes(canvas);
    for (const double theta : theta_i_deg_)
        frame.paint_direction(canvas, theta, stroke_of(style, PlotInk::Mirror, CurveLook::Dashes));
    for (const PlotCurve& curve : set_.curves)
        if (set_.error_band && !curve.error.empty()) frame.paint_band(canvas, curve);
    for (const PlotCurve& curve : set_.curves) frame.paint_line(canvas, curve);
    for (const double theta : theta_i_deg_) frame.paint_light(canvas, -theta);
}

std::optional<PlotReading> PolarPlot::reading(Place place, const Box& area,
                                              const PlotStyle& style) const {
    const PolarFrame frame = this->frame(area, style);
    const auto theta = frame.theta_at(place);
    if (set_.empty() || !theta) return std::nullopt;
    const PlotCurve& first = set_.curves.front();
    const std::size_t k = set_.nearest(*theta);
    PlotReading reading;
    reading.text = set_.reading_at(k);
    if (k < first.cells.size()) reading.cell = first.cells[k];
    reading.guide = {frame.centre(), frame.map(first.x[k], axis_.high)};
    for (const PlotCurve& curve : set_.curves)
        if (const auto y = value_at(curve, first.x[k]))
            reading.dots.push_back({frame.map(first.x[k], *y), curve.ink});
    return reading;
}

}  // namespace asperity::plots
