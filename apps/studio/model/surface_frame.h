// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/render/camera.h>
#include <asperity/surface/heightfield.h>

#include <algorithm>

namespace asperity::studio {

/// Between a surface, z its mean normal, and the world of its scene, y up: the tile's middle lies
/// at the origin and its longer side is kTileSide long. World x = surface x, y = z, z = -y, the
/// thesis' frame (eq. 4.5); heights keep their true proportion.
struct SurfaceFrame {
    static constexpr double kTileSide = 2;

    double scale = 1;  ///< world lengths per length on the surface
    Vec3 middle;       ///< of tile and heights, on the surface

    static SurfaceFrame of(const Heightfield& surface, double lowest, double highest) {
        const double x = surface.dx * surface.cells_x(), y = surface.dy * surface.cells_y();
        return {kTileSide / std::max(x, y), {0.5 * x, 0.5 * y, 0.5 * (lowest + highest)}};
    }

    static constexpr Vec3 direction_to_world(Vec3 d) { return {d.x, d.z, -d.y}; }
    static constexpr Vec3 direction_to_surface(Vec3 d) { return {d.x, -d.z, d.y}; }
    Vec3 to_world(Vec3 p) const { return scale * direction_to_world(p - middle); }
    Vec3 to_surface(Vec3 p) const { return (1 / scale) * direction_to_surface(p) + middle; }

    WorldRay to_surface(const WorldRay& ray) const {
        return {to_surface(ray.origin), direction_to_surface(ray.direction)};
    }
    Camera to_surface(const Camera& camera) const {
        return {to_surface(camera.position), direction_to_surface(camera.forward),
                direction_to_surface(camera.up), camera.fov_deg};
    }
};

}  // namespace asperity::studio
