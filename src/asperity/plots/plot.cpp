// SPDX-License-Identifier: Apache-2.0
#include <asperity/plots/plot.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::plots {

namespace {

/// A header with a comma or a quote stands in quotes, RFC 4180.
std::string csv_header(const std::string& header) {
    if (header.find_first_of(",\"\n") == header.npos) return header;
    std::string quoted = "\"";
    for (const char c : header) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace

std::string csv_text(const PlotTable& table) {
    std::string text;
    std::size_t rows = 0;
    for (const auto& [header, values] : table.columns) {
        if (!text.empty()) text += ',';
        text += csv_header(header);
        rows = std::max(rows, values.size());
    }
    text += '\n';
    for (std::size_t row = 0; row < rows; ++row) {
        const char* comma = "";
        for (const PlotTable::Column& column : table.columns) {
            text += comma;
            comma = ",";
            if (row < column.values.size() && std::isfinite(column.values[row]))
                text += fmt::format("{}", column.values[row]);
        }
        text += '\n';
    }
    return text;
}

void MessagePlot::paint(Canvas& canvas, const Box& area, const PlotStyle& style) const {
    canvas.fill(area, style.paper);
    const std::vector<std::string> lines = style.wrapped(message_, 0.9 * area.width, style.font);
    const double step = style.line_height();
    Place place = area.centre() - Place{0, step * (static_cast<double>(lines.size()) - 1) / 2};
    for (const std::string& line : lines) {
        canvas.text(place, line, style.font, style.faint, TextAlign::Centre);
        place.y += step;
    }
}

}  // namespace asperity::plots
