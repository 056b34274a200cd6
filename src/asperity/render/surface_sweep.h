// SPDX-License-Identifier: Apache-2.0
// How the built-in models are made: surfaces over a square of (u, v).
#pragma once

#include <asperity/core/vec.h>
#include <asperity/render/mesh.h>

#include <functional>
#include <string>
#include <vector>

namespace asperity::detail {

struct SweptVertex {
    Vec3 position, normal;  ///< the normal a unit vector
};

/// What a surface does at v = 0 and v = 1.
enum class SweepEnds {
    Poles,  ///< each of both edges is one point
    Join,   ///< they are one edge: the surface is a ring
};

/// A grid over a surface that is closed in u.
struct SweepGrid {
    int columns = 0;  ///< in u, 0 .. 1, once round
    int rows = 0;     ///< in v, 0 .. 1
    SweepEnds ends = SweepEnds::Poles;
};

/// Surface over (u, v): u runs to the right and v down for who looks from outside.
using SweptSurface = std::function<SweptVertex(double u, double v)>;

/// (columns + 1) * (rows + 1) vertices, those of a seam and of a pole doubled with the same bits;
/// 2 * columns * rows triangles, 2 * columns less with poles.
TriangleMesh sweep(std::string name, const SweepGrid& grid, const SweptSurface& surface);

/// Half of an outline in the plane of a body's axis: r >= 0 from the axis, y along it.
struct ProfilePoint {
    double r = 0, y = 0;
    double normal_r = 0, normal_y = 0;  ///< unit vector out of the body
};

/// The body that the profile draws when it is turned about the y axis. It must start on the axis,
/// on top, and end on it, below.
TriangleMesh lathe(std::string name, const std::vector<ProfilePoint>& profile, int columns);

/// A corner of an outline, rounded by a circle of `radius`; 0 leaves it alone.
struct ProfileCorner {
    double r = 0, y = 0, radius = 0;
};

/// The outline through the corners, first and last on the axis, its lines level there. Corners in
/// between need a radius, and their circles room on both lines.
std::vector<ProfilePoint> rounded_profile(const std::vector<ProfileCorner>& corners);

}  // namespace asperity::detail
