// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/detector.h>
#include <asperity/pictures/canvas.h>

#include <string>
#include <vector>

namespace asperity::io {

/// What a model gives and what there is, for one incidence; per cell of a detector, NaN where
/// nothing is compared.
struct ResidualTile {
    double theta_i = 0, phi_i = 0;  ///< [rad]
    std::vector<double> data, model;
    std::string note;  ///< below the picture
};

/// Writes a sheet of disks, a tile each: model over data, from half (blue) over equal (grey) to
/// twice (orange). `title` and `line` stand on top. Throws Error(InputOutput, path), Error(Usage,
/// path) when there is no tile.
void write_residual_sheet(const Detector& detector, const std::vector<ResidualTile>& tiles,
                          const std::string& title, const std::string& line,
                          const std::string& path);

/// The colour of model / data. Equal values, zeros
/// included, are grey.
Colour residual_colour(double model, double data);

}  // namespace asperity::io
