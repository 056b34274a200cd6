// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/areal_parameters.h>
#include <asperity/surface/geometric_optics.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/slope_fit.h>

#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// The figures a laboratory quotes of a surface, and what they say of following rays over it.
struct TextureFigures {
    ArealParameters areal;
    std::optional<SlopeFit> beckmann, ggx;  ///< none where too many slopes are zero
    std::optional<GeometricOptics> optics;  ///< of a surface in metres
};

/// Of the surface as it was measured and made ready, before it is mirrored. `wavelength` in metres.
/// Cost: that of areal_parameters() and two fits to the slopes. Throws Error(Stopped).
TextureFigures texture_figures(const Heightfield& patch, double wavelength, Run& run);

/// A figure in words, "Sa, Sq" and "0.12 um  0.15 um"; without a name `value` is a sentence.
struct TextureRow {
    std::string name, value;
};

/// All figures in the order in which they are quoted; lengths in units that suit them.
std::vector<TextureRow> texture_rows(const TextureFigures& figures, const Heightfield& patch);

}  // namespace asperity
