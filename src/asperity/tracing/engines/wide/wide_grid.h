// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engines/wide/horizon.h>
#include <asperity/tracing/engines/wide/padded_heights.h>

#include <cstdint>

namespace asperity {

/// The surface as the kernels of the wide tracer see it. Refers to heights and horizon.
struct WideGrid {
    WideGrid(const PaddedHeights& heights, const Horizon& horizon);

    // How to trace follows from the surface alone, never from how it went so far: the same bits
    // for any number of threads. Which way memory is read follows from the processor; it changes
    // no bit.

    const float* middle;  ///< sample (middle_x, middle_y): packed vertices are counted from here
    int pitch;            ///< samples from row to row
    int middle_x, middle_y, cells_x, cells_y;
    bool periodic;
    float per_x, per_y;  ///< cells per unit of length
    float max_height;
    float steepest;               ///< no facet is steeper: whoever climbs more steeply escapes
    const std::uint8_t* horizon;  ///< the 16 bytes of the middle cell's block
    int horizon_pitch, pool_shift;
    bool horizon_pays;         ///< enough paths are free by their facet's horizon to look at it
    bool leaps_pay;            ///< the surface is smooth enough for paths to leap
    bool few_azimuths;         ///< facets look into a few azimuths alone, as those of grooves
    bool gathers_pay = false;  ///< as gathers_pay(), which is asked by the tracer
    float longest_leap;        ///< cells a path may leap over, so that one wrap brings it home
};

}  // namespace asperity
