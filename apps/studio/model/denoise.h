// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/render/camera.h>
#include <asperity/render/film.h>
#include <asperity/render/traced_model.h>

#include <vector>

namespace asperity::studio {

/// What lies in the middle of each pixel: the guides by which noise is told from edges. Row by row.
struct PixelGuides {
    int width = 0, height = 0;
    std::vector<float> nx, ny, nz;  ///< shading normal; zero where nothing is hit
    std::vector<float> px, py, pz;  ///< place
    std::vector<float> reach;       ///< so far a neighbour may lie off the plane; 0: no neighbours
};

/// Traces one ray a pixel. `split`: share of the width where another material begins, 1: none; the
/// two sides are no neighbours. Unfinished when the run was stopped.
PixelGuides look_for_guides(const TracedModel& model, const Camera& camera, int width, int height,
                            double split, Run& run);

/// Pictures of few samples a pixel without their noise: an edge-avoiding a-trous filter (Dammertz
/// et al. 2010, "Edge-avoiding a-trous wavelet transform for fast global illumination filtering"),
/// guided by normals, places and, as in Schied et al. 2017 ("Spatiotemporal variance-guided
/// filtering"), by the standard error of each pixel: where the film is sure, nothing is smoothed,
/// so it goes over into the film itself. For the screen alone; what is saved is the film.
///
/// Three floats a pixel, row by row. The same for any number of threads.
std::vector<float> denoised(const Film& film, const PixelGuides& guides, Run& run);

}  // namespace asperity::studio
