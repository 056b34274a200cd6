// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/measured/compare.h>

#include <optional>
#include <string>
#include <vector>

namespace asperity::cli {

/// A surface in one line, as asked for and as it came out: "gaussian, 512 x 512 cells, alpha 0.3
/// asked, 0.2998 realised (x 0.2997, y 0.2999), RMS height 1.2".
std::string surface_line(const SurfaceSettings& settings, const SurfaceStatistics& statistics,
                         int nx, int ny);

/// How a file that need not repeat fills the plane, and that the default was used if so; empty for
/// made surfaces.
std::string tiling_line(const SurfaceSettings& settings, const Heightfield& surface);

/// The word the command line uses for a kind, "gaussian"; a file's name.
std::string kind_name(const SurfaceSettings& settings);

/// "0.93060(12)": as many digits as the error has two of, and those two behind them; "1.00000
/// exact" where there is no error.
std::string with_error(double value, double error);

/// The table of a measurement, a row per layer, or per layer and channel where there are two or
/// three, and what its shares are of. `comparison`, when given, adds the columns of L1
/// and its noise; its rows are found by incident direction.
std::string layer_table(const Measurement& measurement,
                        const std::optional<Comparison>& comparison);

/// How many surfaces there were, and where errors come from; empty where there was one.
std::string surfaces_line(const Measurement& measurement);

/// What stands below the table: rays, seconds, rays/s, notes.
std::string closing_lines(const Measurement& measurement);

// Sums over a measurement.
std::uint64_t launched_total(const Measurement& measurement);
double rays_per_second(const Measurement& measurement);
double mean_bounces(const Layer& layer);

}  // namespace asperity::cli
