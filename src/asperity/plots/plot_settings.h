// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/params/param.h>
#include <asperity/pictures/pictures.h>

#include <string>
#include <vector>

namespace asperity::plots {

enum class PlotAxes { Polar, Cartesian };
enum class PlotScale { Auto, Linear, Log };
enum class ProfileLine { X, Y };

/// What a plot shows of its subjects; which settings count depends on the kind (plot_kinds.h).
struct PlotSettings {
    std::string kind = "lobe";
    PlotAxes axes = PlotAxes::Polar;
    PlotScale scale = PlotScale::Auto;  ///< Auto: what the kind is usually shown in
    double decades = 4;                 ///< of a log axis, below its upper end
    std::vector<double> theta;          ///< angles of incidence [degrees]; empty: nearest to 45
    std::vector<double> layer;          ///< numbers of layers, in place of angles
    double phi = 0;                     ///< azimuth of the light [degrees]
    double plane = 0;                   ///< azimuth of the plane from that of incidence [degrees]
    double average = 0;                 ///< half the strip of a lobe in columns; 0: as noise asks
    bool no_errors = false;             ///< without error bands
    std::string channel;                ///< name or number; empty: the mean of all
    io::ColourMap colour_map = io::ColourMap::Viridis;
    double camera_azimuth = 65;    ///< of the direction a solid is seen from [degrees]
    double camera_elevation = 24;  ///< above the surface [degrees]
    ProfileLine line = ProfileLine::X;
    double line_at = 0.5;  ///< where the line lies across it, 0 .. 1
    std::string title;     ///< empty: made from the data
};

/// The rows of the settings, for options, help and the reference.
ParamTable<PlotSettings> plot_params();

/// Throws Error(Usage, name) for a setting outside its range, an unknown kind, layers beside
/// angles.
void check(const PlotSettings& settings);

}  // namespace asperity::plots
