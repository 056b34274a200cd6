// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drawing.h"

#include <asperity/surface/heightfield.h>

#include <QString>

#include <cstdint>

namespace asperity::studio {

/// What a scene consists of. "Instanced" counts every use of a mesh, "unique" each mesh once.
struct GeometryCounts {
    std::uint64_t meshes = 0, instances = 0;
    std::uint64_t unique_triangles = 0, unique_vertices = 0;
    std::uint64_t instanced_triangles = 0, instanced_vertices = 0;

    /// One for each instance, and the camera's.
    std::uint64_t transform_matrices() const { return instances + 1; }
};

/// As the thesis counts a surface: every cell is a mesh of 2 triangles and 4 vertices.
GeometryCounts geometry_of(const Heightfield& surface);

struct RayCounts {
    double rays = 0;        ///< launched so far, all layers together
    double per_second = 0;  ///< 0: not known
};

/// Of the run under way or, once it is over, of all its layers.
RayCounts rays_of(const Drawing& drawing);

/// The thesis' Statistics (figures 2.6 - 2.8).
struct StudioStatistics {
    double frames_per_second = 0, milliseconds_per_frame = 0;
    int samples = 0;  ///< of each pixel of a view at rest; 0: it moves
    GeometryCounts geometry;
    int resolution = 0;  ///< of the environment map: Texture Resolution
    RayCounts rays;
};

/// The block of lines of figures 2.6 - 2.8, with the rays per second added.
QString statistics_text(const StudioStatistics& statistics);

}  // namespace asperity::studio
