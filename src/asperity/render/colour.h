// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/rgb.h>

#include <algorithm>

namespace asperity {

/// Linear sRGB (IEC 61966-2-1) of a colour in CIE XYZ, y > 0. One outside the triangle of the
/// primaries is made paler, just as far as needed, at its luminance: no channel is negative.
inline Rgb rgb_of_xyz(double x, double y, double z) {
    const Rgb c = {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                   -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                   0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
    const double least = std::min({c.r, c.g, c.b});
    if (least >= 0) return c;
    // On the line from the grey of its luminance to the colour, as far as that channel is 0
    const double grey = luminance(c), share = grey / (grey - least);
    const auto paler = [&](double channel) {
        return std::max(0.0, grey + share * (channel - grey));
    };
    return {paler(c.r), paler(c.g), paler(c.b)};
}

}  // namespace asperity
