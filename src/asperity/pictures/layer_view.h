// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>
#include <asperity/pictures/canvas.h>
#include <asperity/pictures/colour_map.h>
#include <asperity/pictures/pictures.h>

#include <string>
#include <vector>

namespace asperity::io {

/// f [1/sr] of one layer over the cells of the detector, of one channel or the mean of all.
std::vector<double> values_of(const Measurement& measurement, const Layer& layer, int channel);

/// Albedo of the layer, of one channel or the mean of all.
double shown_albedo(const Measurement& measurement, const Layer& layer, int channel);

/// How values become places on a colour bar.
struct ValueScale {
    Scale scale = Scale::Log;
    double low = 0, high = 1;  ///< [1/sr] at the ends of the bar; low = 0 when linear
    bool clipped = false;      ///< some cells lie above `high`

    /// 0 at `low`, 1 at `high`, clamped.
    double position(double value) const;
};

/// The scale that shows all of `layers`. Its upper end is the first 1, 2 or 5 times a power of ten
/// not below the largest f, where the brightest cells are left out which together carry less than a
/// thousandth of a layer's energy: single rays in the small cells about the pole would take the
/// scale for themselves otherwise.
ValueScale value_scale(const Measurement& measurement, const std::vector<const Layer*>& layers,
                       const SkyMapSettings& settings);

/// Colour of a value; nothing at all is kZeroColour.
Colour colour_of_value(double value, const ValueScale& scale, ColourMap map);

/// Throws Error(Usage) unless decades and channel fit.
void check_settings(const Measurement& measurement, const SkyMapSettings& settings);

/// Paints the hemisphere into `area` by `projection`; a pixel larger than cells shows the
/// cosine-weighted mean of f over itself. `area` of a Disk is a square.
void paint_layer(Canvas& canvas, Rect area, const Measurement& measurement, const Layer& layer,
                 const ValueScale& scale, const SkyMapSettings& settings);

/// Where direction (theta, phi) lies in the picture.
Point place_of(double theta, double phi, Rect area, Projection projection);

/// "0°", "22.5°".
std::string degree_text(double angle);

}  // namespace asperity::io
