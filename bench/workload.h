// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/surface/heightfield.h>

#include <cstdint>
#include <vector>

namespace asperity::bench {

/// A launch point on the plane through the highest point of the surface.
struct StartPoint {
    std::int32_t i, j;  ///< cell
    float u, v;         ///< position inside it, 0 <= . < 1
};

/// What all rivals trace: parallel light onto one tile of perfect mirrors.
struct Workload {
    const Heightfield* surface = nullptr;
    double theta_deg = 0;  ///< of incidence; the azimuth is kPhiDeg
    int bounces = 16;      ///< reflections a path may make
    std::uint64_t seed = 1;
    std::vector<StartPoint> points;  ///< for the rivals that follow a list, see blocked_points
    std::uint64_t own_paths = 0;     ///< how many paths a rival makes that launches by itself

    Vec3 direction() const;  ///< of travel, unit length
};

/// Azimuth the light comes from: along no line of the triangle grid, so no tracer gets its easy
/// case.
inline constexpr double kPhiDeg = 25;

/// Points come in blocks of kBlock x kBlock surface cells, one point at a random place in each
/// cell, along a Z-order curve: as dense as a measurement with one ray per cell, so that every
/// tracer finds in its caches what it would find there.
inline constexpr int kBlock = 64;

/// `count` points, a multiple of kBlock^2, in blocks spread over the surface; with more blocks than
/// the surface has, each is used again, and another seed goes on with other blocks. The side of the
/// surface is a multiple of kBlock.
std::vector<StartPoint> blocked_points(const Heightfield& surface, int count, std::uint64_t seed);

}  // namespace asperity::bench
