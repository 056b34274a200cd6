// SPDX-License-Identifier: Apache-2.0
#include "plot_files.h"

#include "plot_canvas.h"
#include "save_bytes.h"

#include <asperity/core/error.h>

#include <fmt/format.h>

#include <QBuffer>
#include <QFileInfo>
#include <QSvgGenerator>

#include <cmath>
#include <iterator>
#include <string>

namespace asperity::studio {

namespace {

QByteArray png_data(const Plot& plot, QSize size, const PlotStyle& style) {
    constexpr double kPixelsToOne = 2;
    return png_bytes(plot_image(plot, size, kPixelsToOne, style));
}

QByteArray svg_data(const Plot& plot, QSize size, const PlotStyle& style) {
    constexpr int kDotsPerInch = 96;  // an SVG unit is a CSS pixel
    QByteArray data;
    QBuffer buffer(&data);
    buffer.open(QIODevice::WriteOnly);
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setResolution(kDotsPerInch);
    generator.setSize(size);
    generator.setViewBox(QRect(QPoint(), size));
    generator.setTitle(QStringLiteral("Asperity"));
    QPainter painter(&generator);
    plot.paint(painter, QRectF(QPointF(), QSizeF(size)), style);
    painter.end();
    return data;
}

}  // namespace

QByteArray csv_text(const PlotTable& table) {
    std::string text;
    std::size_t rows = 0;
    for (const auto& [header, values] : table.columns) {
        if (!text.empty()) text += ',';
        text += header.toStdString();
        rows = std::max(rows, values.size());
    }
    text += '\n';
    for (std::size_t row = 0; row < rows; ++row) {
        const char* comma = "";
        for (const PlotTable::Column& column : table.columns) {
            text += comma;
            comma = ",";
            if (row < column.values.size() && std::isfinite(column.values[row]))
                fmt::format_to(std::back_inserter(text), "{}", column.values[row]);
        }
        text += '\n';
    }
    return QByteArray::fromStdString(text);
}

void write_plot(const Plot& plot, QSize size, const PlotStyle& style, const QString& path) {
    const QString ending = QFileInfo(path).suffix().toLower();
    QByteArray data;
    if (ending == "png")
        data = png_data(plot, size, style);
    else if (ending == "svg")
        data = svg_data(plot, size, style);
    else if (ending == "csv")
        data = csv_text(plot.table());
    else
        throw Error(ErrorCode::Usage, "a plot is saved as .png, .svg or .csv", path.toStdString());
    save_bytes(data, path);
}

}  // namespace asperity::studio
