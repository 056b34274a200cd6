// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot_curves.h>

#include <asperity/plots/plot_axis.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::plots {

namespace {

constexpr double kModelsStandOut = 4;
constexpr double kSameX = 1e-9;
constexpr double kSpike = 2;  ///< an end of a curve that is so many times its neighbour
constexpr std::size_t kFewestForSpikes = 8;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Curves that lie upon each other are both seen, and told apart without colour. In widths of the
/// line.
std::vector<double> dashes_of(PlotInk ink) {
    switch (ink) {
        case PlotInk::Ggx:
        case PlotInk::Sixth:
            return {7, 2, 1.5, 2};
        case PlotInk::Beckmann:
        case PlotInk::Seventh:
            return {2.5, 1.5};
        case PlotInk::Fifth:
            return {9, 2.5};
        case PlotInk::Eighth:
            return {7, 2, 1.5, 2, 1.5, 2};
        default:
            return {5, 2.5};
    }
}

double sample_width(const PlotStyle& style) {
    return 2 * style.line_height();
}

/// The largest value of a curve, an end that stands out of its neighbour left aside.
double top_of(const PlotCurve& curve) {
    const std::vector<double>& y = curve.y;
    const auto spikes = [&](std::size_t end, std::size_t neighbour) {
        return y.size() >= kFewestForSpikes && y[end] > kSpike * y[neighbour];
    };
    double most = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        if (!std::isfinite(y[k])) continue;
        if (k == 0 && spikes(0, 1)) continue;
        if (k + 1 == y.size() && spikes(k, k - 1)) continue;
        most = std::max(most, y[k]);
    }
    return most;
}

}  // namespace

double CurveSet::top() const {
    double measured = 0, modelled = 0;
    for (const PlotCurve& curve : curves) {
        double& most = curve.look == CurveLook::Dashes ? modelled : measured;
        most = std::max(most, top_of(curve));
    }
    return measured > 0 ? std::max(measured, std::min(modelled, kModelsStandOut * measured))
                        : modelled;
}

std::string CurveSet::cut_off(double high) const {
    std::string text;
    for (const PlotCurve& curve : curves) {
        std::size_t most = curve.y.size();
        for (std::size_t k = 0; k < curve.y.size(); ++k)
            if (curve.y[k] > high * (1 + kSameX) &&
                (most == curve.y.size() || curve.y[k] > curve.y[most]))
                most = k;
        if (most == curve.y.size()) continue;
        text += fmt::format("{}{} reaches {} at {} = {}{}", text.empty() ? "Cut off: " : "; ",
                            curve.name, value_text(curve.y[most]), x_name,
                            value_text(curve.x[most]), x_unit);
    }
    return text;
}

std::string CurveSet::note_with(double high) const {
    const std::string cut = cut_off(high);
    return note.empty() || cut.empty() ? note + cut : note + ". " + cut;
}

std::size_t CurveSet::nearest(double x) const {
    const std::vector<double>& xs = curves.front().x;
    const auto by_distance = [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); };
    return static_cast<std::size_t>(std::min_element(xs.begin(), xs.end(), by_distance) -
                                    xs.begin());
}

std::string CurveSet::reading_at(std::size_t k) const {
    const double x = curves.front().x[k];
    std::string text = fmt::format("{} = {}{}", x_name, value_text(x), x_unit);
    for (const PlotCurve& curve : curves) {
        const auto y = value_at(curve, x);
        if (!y) continue;
        const std::string& name = curve.brief.empty() ? curve.name : curve.brief;
        text += fmt::format("   {}: {}", name, value_text(*y));
        if (k < curve.error.size()) text += " ± " + error_text(curve.error[k]);
    }
    if (!y_unit.empty()) text += fmt::format("   [{}]", y_unit);
    return text;
}

PlotTable CurveSet::table() const {
    // Rows: every x of any curve
    std::vector<double> xs;
    for (const PlotCurve& curve : curves) xs.insert(xs.end(), curve.x.begin(), curve.x.end());
    std::sort(xs.begin(), xs.end());
    xs.erase(std::unique(xs.begin(), xs.end(),
                         [](double a, double b) { return std::abs(a - b) < kSameX; }),
             xs.end());
    const auto spread = [&](const std::vector<double>& at, const std::vector<double>& values) {
        std::vector<double> column(xs.size(), kNone);
        for (std::size_t k = 0; k < at.size(); ++k) {
            const auto row = std::lower_bound(xs.begin(), xs.end(), at[k] - kSameX);
            column[static_cast<std::size_t>(row - xs.begin())] = values[k];
        }
        return column;
    };
    PlotTable table{{{x_column, xs}}};
    for (const PlotCurve& curve : curves) {
        table.columns.push_back({curve.column, spread(curve.x, curve.y)});
        if (!curve.error.empty())
            table.columns.push_back(
                {"standard error of " + curve.column, spread(curve.x, curve.error)});
    }
    for (const auto& [header, values] : more)
        table.columns.push_back({header, spread(curves.front().x, values)});
    return table;
}

std::optional<double> value_at(const PlotCurve& curve, double x) {
    const auto above = std::lower_bound(curve.x.begin(), curve.x.end(), x - kSameX);
    if (above == curve.x.end()) return std::nullopt;
    const std::size_t k = static_cast<std::size_t>(above - curve.x.begin());
    if (std::abs(curve.x[k] - x) < kSameX) return curve.y[k];
    if (k == 0) return std::nullopt;
    const double t = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
    return curve.y[k - 1] + t * (curve.y[k] - curve.y[k - 1]);
}

std::vector<LegendEntry> legend_of(const CurveSet& set) {
    std::vector<LegendEntry> legend;
    for (const PlotCurve& curve : set.curves) {
        const bool errors = set.error_band && !curve.error.empty();
        const bool band = errors && curve.look == CurveLook::Line;
        legend.push_back(
            {band ? curve.name + " ± 1 standard error" : curve.name, curve.ink, curve.look, band});
    }
    return legend;
}

std::vector<PlacedEntry> placed_entries(const std::vector<LegendEntry>& legend, const Box& area,
                                        const PlotStyle& style, double top) {
    const double height = style.line_height();
    std::vector<PlacedEntry> result;
    double x = area.left + 0.5 * height, y = top + 0.6 * height;
    for (const LegendEntry& entry : legend) {
        const double width = box_of({entry, {}}, style).width;
        if (x + width > area.right() && x > area.left + height) {
            x = area.left + 0.5 * height;
            y += 1.15 * height;
        }
        result.push_back({entry, {x, y}});
        x += width + height;
    }
    return result;
}

Box box_of(const PlacedEntry& placed, const PlotStyle& style) {
    const double height = style.line_height();
    return {placed.place.x, placed.place.y - 0.6 * height,
            sample_width(style) + 0.4 * height + style.width_of(placed.entry.text), 1.2 * height};
}

void paint_entry(Canvas& canvas, const PlotStyle& style, const PlacedEntry& placed) {
    const double height = style.line_height(), width = sample_width(style);
    const auto& [entry, place] = placed;
    if (entry.band)
        canvas.fill({place.x, place.y - 0.32 * height, width, 0.64 * height},
                    style.ink(entry.ink).with_opacity(0.22));
    canvas.line(place, place + Place{width, 0}, stroke_of(style, entry.ink, entry.look));
    if (entry.look == CurveLook::Marks)
        paint_dot(canvas, style, place + Place{width / 2, 0}, entry.ink);
    canvas.text(place + Place{width + 0.4 * height, 0}, entry.text, style.font, style.text,
                TextAlign::Left);
}

std::vector<PlacedLine> placed_lines(const Box& area, const PlotStyle& style,
                                     const Heading& heading) {
    const double line = style.line_height(), left = area.left + 0.5 * line;
    const double room = area.width - line;
    std::vector<PlacedLine> lines;
    double y = area.top + 0.17 * line;
    for (const std::string& words : style.wrapped(heading.title, room, style.title)) {
        lines.push_back({words, {left, y, style.width_of(words, style.title), 1.25 * line}, true});
        y += 1.25 * line;
    }
    y += lines.empty() ? 0.13 * line : 0.18 * line;
    for (const std::string& words : style.wrapped(heading.note, room, style.small)) {
        lines.push_back({words, {left, y, style.width_of(words, style.small), 1.05 * line}});
        y += 1.05 * line;
    }
    return lines;
}

double below_lines(const Box& area, const PlotStyle& style, const Heading& heading) {
    const std::vector<PlacedLine> lines = placed_lines(area, style, heading);
    if (lines.empty()) return area.top + 0.3 * style.line_height();
    return lines.back().box.bottom() + (lines.back().title ? 0.18 * style.line_height() : 0);
}

void paint_lines(Canvas& canvas, const PlotStyle& style, const std::vector<PlacedLine>& lines) {
    for (const PlacedLine& line : lines)
        canvas.text({line.box.left, line.box.centre().y}, line.text,
                    line.title ? style.title : style.small, line.title ? style.text : style.faint,
                    TextAlign::Left);
}

Box below_heading(const Box& area, const PlotStyle& style, const Heading& heading) {
    double bottom = below_lines(area, style, heading);
    const auto entries = placed_entries(heading.legend, area, style, bottom);
    if (!entries.empty()) bottom = entries.back().place.y + 0.9 * style.line_height();
    return {area.left, bottom, area.width, area.bottom() - bottom};
}

Box paint_heading(Canvas& canvas, const Box& area, const PlotStyle& style, const Heading& heading) {
    canvas.fill(area, style.paper);
    paint_lines(canvas, style, placed_lines(area, style, heading));
    for (const PlacedEntry& entry :
         placed_entries(heading.legend, area, style, below_lines(area, style, heading)))
        paint_entry(canvas, style, entry);
    return below_heading(area, style, heading);
}

Stroke stroke_of(const PlotStyle& style, PlotInk ink, CurveLook look) {
    const double width = style.line_height() / 9;
    if (look != CurveLook::Dashes) return {style.ink(ink), width};
    Stroke stroke{style.ink(ink), 0.85 * width, dashes_of(ink)};
    for (double& length : stroke.dashes) length *= stroke.width;
    return stroke;
}

void paint_band(Canvas& canvas, const PlotStyle& style, const PlotCurve& curve, double opacity,
                const std::function<Place(double, double)>& place) {
    std::vector<Place> band;
    const auto add = [&](std::size_t k, double sign) {
        const double error = std::isfinite(curve.error[k]) ? curve.error[k] : 0.0;
        band.push_back(place(curve.x[k], curve.y[k] + sign * error));
    };
    for (std::size_t k = 0; k < curve.x.size(); ++k) add(k, 1);
    for (std::size_t k = curve.x.size(); k-- > 0;) add(k, -1);
    canvas.polygon(band, style.ink(curve.ink).with_opacity(opacity));
}

void paint_dot(Canvas& canvas, const PlotStyle& style, Place place, PlotInk ink) {
    const double radius = 0.22 * style.line_height();
    canvas.disc(place, 1.18 * radius, style.paper);
    canvas.disc(place, 0.85 * radius, style.ink(ink));
}

}  // namespace asperity::plots
