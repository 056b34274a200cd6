// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_frame.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::plots {

namespace {

double widest_label(const std::vector<PlotTick>& ticks, const PlotStyle& style) {
    double width = 0;
    for (const PlotTick& tick : ticks)
        width = std::max(width, style.width_of(tick.label, style.small));
    return width;
}

double mark_length(const PlotTick& tick, double line) {
    return (tick.label.empty() ? 0.18 : 0.32) * line;
}

/// Bars on a place, for errors.
void paint_bar(Canvas& canvas, Place top, Place bottom, double half_width, const Stroke& stroke) {
    canvas.line(top, bottom, stroke);
    for (const Place end : {top, bottom})
        canvas.line(end - Place{half_width, 0}, end + Place{half_width, 0}, stroke);
}

}  // namespace

PlotFrame::PlotFrame(const Box& area, PlotAxis x, PlotAxis y, const PlotStyle& style)
    : x_(std::move(x)), y_(std::move(y)), style_(style) {
    const double line = style.line_height();
    const double height = std::max(1.0, area.height - 3.7 * line);
    y_ticks_ = y_.ticks(std::max(2, static_cast<int>(height / (2.5 * line))));
    const double left = widest_label(y_ticks_, style) + 2.3 * line;
    const double width = std::max(1.0, area.width - left - 1.2 * line);
    x_ticks_ = x_.ticks(std::max(2, static_cast<int>(width / (4 * line))));
    inside_ = {area.left + left, area.top + 0.5 * line, width, height};
}

double PlotFrame::y_place(double y) const {
    return inside_.bottom() - y_.position(y) * inside_.height;
}

double PlotFrame::clamped(double place) const {
    return std::clamp(place, inside_.top, inside_.bottom());
}

Place PlotFrame::map(double x, double y) const {
    return {inside_.left + x_.position(x) * inside_.width, y_place(y)};
}

double PlotFrame::x_at(double place) const {
    return x_.value_at((place - inside_.left) / inside_.width);
}

void PlotFrame::paint_x_ticks(Canvas& canvas) const {
    const double line = style_.line_height();
    for (const PlotTick& tick : x_ticks_) {
        const double x = map(tick.value, y_.low).x;
        if (!tick.label.empty()) {
            canvas.line({x, inside_.top}, {x, inside_.bottom()}, {style_.grid, 1});
            canvas.text({x, inside_.bottom() + 0.75 * line}, tick.label, style_.small, style_.faint,
                        TextAlign::Centre);
        }
        canvas.line({x, inside_.bottom()}, {x, inside_.bottom() - mark_length(tick, line)},
                    {style_.faint, 1});
    }
}

void PlotFrame::paint_y_ticks(Canvas& canvas) const {
    const double line = style_.line_height();
    for (const PlotTick& tick : y_ticks_) {
        const double y = y_place(tick.value);
        if (!tick.label.empty()) {
            canvas.line({inside_.left, y}, {inside_.right(), y}, {style_.grid, 1});
            canvas.text({inside_.left - 0.4 * line, y}, tick.label, style_.small, style_.faint,
                        TextAlign::Right);
        }
        canvas.line({inside_.left, y}, {inside_.left + mark_length(tick, line), y},
                    {style_.faint, 1});
    }
}

void PlotFrame::paint_axes(Canvas& canvas) const {
    const double line = style_.line_height();
    paint_x_ticks(canvas);
    paint_y_ticks(canvas);
    canvas.frame(inside_, {style_.faint, 1});
    canvas.text({inside_.centre().x, inside_.bottom() + 2.2 * line}, x_.label, style_.font,
                style_.text, TextAlign::Centre);
    canvas.text({inside_.left - widest_label(y_ticks_, style_) - 1.4 * line, inside_.centre().y},
                y_.label, style_.font, style_.text, TextAlign::Centre, 90);
}

void PlotFrame::paint_line(Canvas& canvas, const PlotCurve& curve) const {
    const Stroke stroke = stroke_of(style_, curve.ink, curve.look);
    std::vector<Place> path;
    const auto finish = [&] {
        if (path.size() > 1) canvas.polyline(path, stroke);
        path.clear();
    };
    const double top = inside_.top, bottom = inside_.bottom();
    for (std::size_t k = 1; k < curve.x.size(); ++k) {
        if (std::isnan(curve.y[k - 1]) || std::isnan(curve.y[k])) continue;
        // What lies at minus infinity of a log axis is drawn from one height below it
        const double lowest = bottom + inside_.height;
        Place a = map(curve.x[k - 1], curve.y[k - 1]), b = map(curve.x[k], curve.y[k]);
        a.y = std::min(a.y, lowest);
        b.y = std::min(b.y, lowest);
        // Cut the stroke at top and bottom
        const auto at = [a, b](double y) { return a + (y - a.y) / (b.y - a.y) * (b - a); };
        if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
        if (b.x > inside_.right() + 0.5) break;
        const auto inside = [&](Place end) {
            return end.y < top ? at(top) : end.y > bottom ? at(bottom) : end;
        };
        const Place from = inside(a), to = inside(b);
        if (path.empty() || path.back() != from) {
            finish();
            path.push_back(from);
        }
        path.push_back(to);
    }
    finish();
}

void PlotFrame::paint_band(Canvas& canvas, const PlotCurve& curve) const {
    asperity::plots::paint_band(canvas, style_, curve, 0.22, [this](double x, double y) {
        const Place place = map(x, y);
        return Place{place.x, clamped(place.y)};
    });
}

void PlotFrame::paint_marks(Canvas& canvas, const PlotCurve& curve, bool errors) const {
    const double half_width = 0.25 * style_.line_height();
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const Place place = map(curve.x[k], curve.y[k]);
        if (errors && k < curve.error.size() && std::isfinite(curve.error[k])) {
            const double low = y_place(curve.y[k] - curve.error[k]);
            const double high = y_place(curve.y[k] + curve.error[k]);
            if (high < inside_.bottom())
                paint_bar(canvas, {place.x, clamped(high)}, {place.x, clamped(low)}, half_width,
                          {style_.ink(curve.ink), style_.line_height() / 14});
        }
        if (place.y >= inside_.top - 1 && place.y <= inside_.bottom() + 1)
            paint_dot(canvas, style_, place, curve.ink);
    }
}

void PlotFrame::paint_upright(Canvas& canvas, double x, const Stroke& stroke) const {
    const double place = map(x, y_.high).x;
    canvas.line({place, inside_.top}, {place, inside_.bottom()}, stroke);
}

CurvePlot::CurvePlot(CurveSet set, PlotAxis x, PlotAxis y, std::vector<Upright> uprights)
    : set_(std::move(set)), x_(std::move(x)), y_(std::move(y)), uprights_(std::move(uprights)) {}

Heading CurvePlot::heading() const {
    Heading heading{set_.title, set_.note_with(y_.high), legend_of(set_)};
    for (const Upright& upright : uprights_)
        if (!upright.name.empty())
            heading.legend.push_back({upright.name, upright.ink, CurveLook::Dashes});
    return heading;
}

PlotFrame CurvePlot::frame(const Box& area, const PlotStyle& style) const {
    return {below_heading(area, style, heading()), x_, y_, style};
}

void CurvePlot::paint(Canvas& canvas, const Box& area, const PlotStyle& style) const {
    paint_heading(canvas, area, style, heading());
    const PlotFrame frame = this->frame(area, style);
    frame.paint_axes(canvas);
    for (const Upright& upright : uprights_)
        frame.paint_upright(canvas, upright.x, stroke_of(style, upright.ink, CurveLook::Dashes));
    for (const PlotCurve& curve : set_.curves)
        if (set_.error_band && curve.look == CurveLook::Line && !curve.error.empty())
            frame.paint_band(canvas, curve);
    for (const PlotCurve& curve : set_.curves) frame.paint_line(canvas, curve);
    for (const PlotCurve& curve : set_.curves)
        if (curve.look == CurveLook::Marks) frame.paint_marks(canvas, curve, set_.error_band);
}

std::optional<PlotReading> CurvePlot::reading(Place place, const Box& area,
                                              const PlotStyle& style) const {
    const PlotFrame frame = this->frame(area, style);
    if (set_.empty() || !frame.inside().contains(place)) return std::nullopt;
    const PlotCurve& first = set_.curves.front();
    const std::size_t k = set_.nearest(frame.x_at(place.x));
    PlotReading reading;
    reading.text = set_.reading_at(k);
    if (k < first.cells.size()) reading.cell = first.cells[k];
    const double x = frame.map(first.x[k], 0).x;
    reading.guide = {{x, frame.inside().top}, {x, frame.inside().bottom()}};
    for (const PlotCurve& curve : set_.curves)
        if (const auto y = value_at(curve, first.x[k])) {
            const Place dot = frame.map(first.x[k], *y);
            if (dot.y >= frame.inside().top && dot.y <= frame.inside().bottom())
                reading.dots.push_back({dot, curve.ink});
        }
    return reading;
}

}  // namespace asperity::plots
