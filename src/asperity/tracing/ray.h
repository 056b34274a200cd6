// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <cstdint>

namespace asperity {

/// Where a ray stands: cell (i, j), position inside it in [0, 1], height, and direction of travel.
/// Positions are kept relative to the cell, so they are equally exact everywhere and a periodic
/// surface needs no wrapping of coordinates.
struct Ray {
    std::int32_t i = 0, j = 0;
    double u = 0, v = 0;      ///< x = (i + u) dx, y = (j + v) dy
    double z = 0;             ///< [unit of the surface]
    Vec3 direction;           ///< of travel, unit length
    std::int32_t facet = -1;  ///< Triangle the ray starts on, -1: free above the surface
    /// Tiles of a periodic surface the ray has gone over, right and down positive. The plain
    /// tracer counts them, the wide one does not.
    std::int32_t tiles_x = 0, tiles_y = 0;
};

/// What became of a ray.
enum class RayEnd : std::uint8_t {
    Hit,      ///< stands on a facet now: (i, j, facet)
    Escaped,  ///< left for good through the plane z = max_height
    Edge,     ///< left through the side of a finite patch, below max_height
    Stuck,    ///< met its engine's step limit, e.g. level in a groove; counted
};

}  // namespace asperity
