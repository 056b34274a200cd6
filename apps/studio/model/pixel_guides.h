// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/render/camera.h>
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

/// The same in a third of the time: traces every second pixel of every second row, and of the
/// others those whose neighbours are not of one smooth surface. What is narrower than two pixels
/// may be missed.
PixelGuides guess_guides(const TracedModel& model, const Camera& camera, int width, int height,
                         double split, Run& run);

}  // namespace asperity::studio
