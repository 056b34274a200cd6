// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plot.h"

#include <QSize>
#include <QString>

namespace asperity::studio {

/// Writes a plot by the ending of `path`: .png (two pixels to one of `size`), .svg or .csv. The
/// file appears whole or not at all. Throws Error(Usage) for another ending, Error(InputOutput).
void write_plot(const Plot& plot, QSize size, const PlotStyle& style, const QString& path);

/// The table as text: a line of headers, then a line for each row, numbers with all their digits,
/// separated by commas; what is not finite is left empty.
QByteArray csv_text(const PlotTable& table);

}  // namespace asperity::studio
