// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene_lines.h"

#include <asperity/core/vec.h>

#include <array>

namespace asperity::studio {

/// The incident light of a layer as the thesis draws it (figures 2.10 - 2.12): the box that its
/// parallel light fills on its way through the tile. Its window keeps the size of the tile at every
/// angle, as that of the thesis' light camera does.
struct Beam {
    static constexpr double kReach = 2.2;  ///< of the window from the middle of the tile
    static constexpr double kDepth = 0.6;  ///< how far the box goes on below the tile

    Vec3 to_light;   ///< unit vector in the world
    Vec3 right, up;  ///< half sides of the window

    /// `wi` on the surface, unit length; the patch gives the sides of the tile.
    Beam(Vec3 wi, const SurfaceBody& body);

    /// Corners of the window, counter-clockwise seen from the tile.
    std::array<Vec3, 4> window() const;
};

/// Draws it in red, and for a Camera Jitter above 1 up to four faint copies of its window, far more
/// apart than they are.
void paint_beam(const SceneLines& lines, const Beam& beam, double jitter);

}  // namespace asperity::studio
