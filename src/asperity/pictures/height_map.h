// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>
#include <asperity/surface/topography.h>

#include <string>
#include <vector>

namespace asperity::io {

/// Heights seen from above, row 0 on top, few enough to be shown: one sample in the middle of each
/// pixel.
struct HeightMap {
    int width = 0, height = 0;   ///< [pixels], in the shape of the surface
    std::vector<float> heights;  ///< [row * width + column]; NaN: nothing was measured
    /// Of all heights but the most extreme thousandth on either side: a spike must not hide the
    /// rest.
    double low = 0, high = 0;
    int nx = 0, ny = 0;             ///< samples of the surface
    double size_x = 0, size_y = 0;  ///< of the surface, in `unit`
    std::string unit;

    /// Where a height stands between low and high, 0 .. 1.
    double position(float height) const;
    /// "93.7 um", "12 cell".
    std::string length(double value) const;
    /// "512 x 384 samples, 93.7 um x 70.3 um".
    std::string caption() const;
};

/// `side`: pixels on the longer side. Cost: a pass over the samples.
HeightMap height_map(const Topography& topography, int side);
HeightMap height_map(const Heightfield& surface, int side);

}  // namespace asperity::io
