// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/topography.h>

#include <string>
#include <vector>

namespace asperity::io {

enum class ColourMap { Viridis, Inferno, Grey, ThesisRed };
enum class Scale { Log, Linear };
enum class Projection {
    SkyMap,  ///< latitude-longitude: columns phi_o 0 .. 360 degrees, rows theta_o 0 (top) .. 90
    Disk,    ///< the hemisphere seen from above, radius = sin theta_o
};

struct SkyMapSettings {
    ColourMap colour_map = ColourMap::Inferno;
    Scale scale = Scale::Log;
    double decades = 4;  ///< of the log scale, below its upper end; 0 < decades <= 30
    Projection projection = Projection::SkyMap;
    bool legend = true;       ///< title, axes, colour bar, mirror direction; else the bare picture
    int channel = -1;         ///< -1: the mean of all channels
    bool light = false;       ///< dark on white, for paper
    bool own_scales = false;  ///< of a sheet: each picture has its own scale, which it tells
};

// Common to all pictures. The scale ends at the first 1, 2 or 5 times a power of ten not below the
// largest f; cells that together carry less than a thousandth of a layer's energy may lie above it
// (its label says "≥" then). Cells that received nothing are black, darker than any value. Files
// appear whole or not at all. Throw Error(InputOutput, path); Error(Usage, "decades" | "channel").

/// Writes one layer as a PNG of f [1/sr], about 1000 pixels wide; a sky-map is as wide as the
/// detector has columns, at least.
void write_layer_png(const Measurement& measurement, const Layer& layer, const std::string& path,
                     const SkyMapSettings& settings);

/// Writes every layer into `folder` (made if missing) as layer_15_theta_00.png ..., followed by the
/// azimuth (_phi_030) when there are several; returns the paths written. Every picture has its own
/// scale.
std::vector<std::string> write_layer_pngs(const Measurement& measurement, const std::string& folder,
                                          const SkyMapSettings& settings);

/// Writes all layers on one contact sheet, 1600 pixels wide, with one scale for all, in the order
/// of the measurement. Throws Error(Usage, path) when there is none.
void write_layer_sheet(const Measurement& measurement, const std::string& path,
                       const SkyMapSettings& settings);

/// Looks of a surface seen from above.
enum class SurfaceLook {
    Shaded,   ///< lit from the upper left; slopes scaled to a relief the eye reads, tint by height
    Normals,  ///< the thesis' look: red = |n_x|, green = |n_up|, blue = |n_y|; flat is pure green
};

/// Writes the surface seen from above, row 0 on top, about 1024 pixels on its longer side: large
/// surfaces as means over their facets, small ones facet by facet.
/// Throws Error(InputOutput, path), Error(InvalidInput, path) for a surface that is not valid.
void write_surface_png(const Heightfield& surface, const std::string& path, SurfaceLook look);

/// Writes the Shaded look with the surface's name above and, below, a scale bar and a key of the
/// heights; dark on white, or light on dark. Throws as write_surface_png.
void write_relief_png(const Heightfield& surface, const std::string& path, bool dark);

/// Writes a topography as its file has it and, beside it, the surface that prepare() made of it:
/// heights as colours, each picture with a bar of its own that leaves out the most extreme
/// thousandth on either side; points without a height are black.
/// Throws Error(InputOutput, path).
void write_before_after_png(const Topography& before, const Heightfield& after,
                            const std::string& path);

}  // namespace asperity::io
