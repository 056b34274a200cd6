// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/surface/heightfield.h>

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
    double decades = 4;  ///< of the log scale, below the largest value
    Projection projection = Projection::SkyMap;
    bool legend = true;  ///< title, axes with angles, colour bar with values in 1/sr
    int channel = -1;    ///< -1: the mean of all channels
};

/// Writes one layer as a PNG of f [1/sr].
void write_layer_png(const Measurement& measurement, const Layer& layer, const std::string& path,
                     const SkyMapSettings& settings);

/// Writes every layer into `folder` (made if missing) as layer_15_theta_00.png ...; returns the
/// names written.
std::vector<std::string> write_layer_pngs(const Measurement& measurement, const std::string& folder,
                                          const SkyMapSettings& settings);

/// Writes all layers on one contact sheet.
void write_layer_sheet(const Measurement& measurement, const std::string& path,
                       const SkyMapSettings& settings);

/// Writes the surface seen from above: shaded by a light, or coloured by facet normal (thesis look).
enum class SurfaceLook { Shaded, Normals };
void write_surface_png(const Heightfield& surface, const std::string& path, SurfaceLook look);

/// Writes all layers as a multi-part EXR, one part per incidence, docs/formats.md: channels of f in
/// 1/sr, `stderr.*`, `energy.*` and `bounceK.*`; row 0 = theta_o 0, column 0 = phi_o 0.
void write_layers_exr(const Measurement& measurement, const std::string& path);

}  // namespace asperity::io
