// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>

#include <cstddef>

namespace asperity::studio {

/// Rows of a picture, dealt to threads; those that are left when the run is stopped stay undone.
template <class OfRow>
void each_row(int height, Run& run, const OfRow& of_row) {
    parallel_for(static_cast<std::size_t>(height), run.threads(), [&](std::size_t y) {
        if (!run.stop_requested()) of_row(static_cast<int>(y));
    });
}

/// Of a pixel in a plane of pixels, row by row.
inline std::size_t pixel_index(int width, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
}

}  // namespace asperity::studio
