// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pixel_guides.h"

#include <asperity/core/run.h>
#include <asperity/render/film.h>

#include <vector>

namespace asperity::studio {

/// Pictures of few samples a pixel without their noise: an edge-avoiding a-trous filter (Dammertz
/// et al. 2010, "Edge-avoiding a-trous wavelet transform for fast global illumination filtering"),
/// guided by normals, places and, as in Schied et al. 2017 ("Spatiotemporal variance-guided
/// filtering"), by the standard error of each pixel: where the film is sure, nothing is smoothed,
/// so it goes over into the film itself. For the screen alone; what is saved is the film.
///
/// Three floats a pixel, row by row. The same for any number of threads.
std::vector<float> denoised(const Film& film, const PixelGuides& guides, Run& run);

}  // namespace asperity::studio
