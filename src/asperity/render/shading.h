// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/render/traced_model.h>

namespace asperity {

/// The frame in which a Bsdf is asked: z the normal, x and y in the surface.
struct ShadingFrame {
    Vec3 x, y, z;  ///< orthonormal, right-handed, in the world

    Vec3 to_local(Vec3 world) const { return {dot(world, x), dot(world, y), dot(world, z)}; }
    Vec3 to_world(Vec3 local) const { return local.x * x + local.y * y + local.z * z; }
};

/// The frame at a point seen from `view` (unit vector to the viewer).
///
/// z is the shading normal, but where smooth normals turn away from the viewer (view . normal below
/// 0.01 at a silhouette, where shading would be black) it is turned towards him just as far as
/// needed, in the plane of both. x is level: along y_world x z, the azimuth of anisotropic BRDFs;
/// where z is vertical x is the world's x.
ShadingFrame shading_frame(const SurfacePoint& point, Vec3 view);

/// Whether light from `light` (unit vector to it) can reach the point: it lies above the triangle,
/// not only above the smooth surface that is shaded, so nothing leaks through.
inline bool lit_from(const SurfacePoint& point, Vec3 light) {
    return dot(point.geometric_normal, light) > 0;
}

/// How much light from `light` is let through, 0 .. 1, where a coarse mesh under smooth normals
/// would end in a hard, faceted shadow line (after Chiang et al. 2019, "Taming the shadow
/// terminator"). 1 where the shading normal is the triangle's, and while the triangle faces the
/// light at least half as much as the smooth surface does: a fine mesh looks like what it is of.
double terminator_softness(const SurfacePoint& point, Vec3 light);

}  // namespace asperity
