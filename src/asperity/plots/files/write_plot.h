// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/plots/plot.h>

#include <string>

namespace asperity::plots {

/// How a plot is laid out in a file.
struct PlotFileSettings {
    double width = 640;     ///< in units of 1/96 inch (CSS pixels)
    double height = 0;      ///< likewise; 0: what the plot fills
    double font_size = 13;  ///< likewise, of the em square
    bool dark = false;      ///< light on dark, for screens
    double scale = 2;       ///< pixels to a unit, of .png
};

/// The endings that write_plot() knows, "svg, pdf, png, csv".
std::string plot_file_endings();
/// Throws Error(Usage, path) unless the ending of `path` is one of them.
void check_plot_path(const std::string& path);

/// The bytes of a plot as "svg", "pdf", "png" or "csv": drawings are the plot in print, 1 unit =
/// 1/96 inch, with their text as outlines (SVG) or as text (PDF); CSV is csv_text of the table.
/// Throws Error(Usage) for another ending, Error(OutOfMemory).
std::string plot_bytes(const Plot& plot, const PlotFileSettings& settings,
                       const std::string& ending);

/// Writes them under `path`, by its ending. The file appears whole or not at all (AtomicFile).
/// Throws Error(Usage, path), Error(InputOutput, path).
void write_plot(const Plot& plot, const PlotFileSettings& settings, const std::string& path);

}  // namespace asperity::plots
