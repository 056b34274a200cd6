// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/pictures/canvas.h>
#include <asperity/pictures/pictures.h>

namespace asperity::io {

/// The colour of `t` in [0, 1] (clamped). Lightness rises evenly with t in the perceptual space
/// Oklab (Ottosson 2020, "A perceptual color space for image processing"), from dark but not black:
/// black is left for cells that received nothing.
Colour colour_of(ColourMap map, double t);

/// The colour of a cell that received nothing.
inline constexpr Colour kZeroColour = {0, 0, 0};

}  // namespace asperity::io
