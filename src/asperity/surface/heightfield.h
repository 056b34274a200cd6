// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace asperity {

/// Which diagonal cuts a cell (i, j) into its two triangles.
enum class Diagonal {
    Anti,  ///< from (i+1, j) to (i, j+1), the thesis' Lower and Upper triangle
    Main,  ///< from (i, j) to (i+1, j+1)
};

/// What lies beyond the last sample.
enum class Boundary {
    Periodic,  ///< the first sample again: nx x ny cells, no edge, no ray lost
    Finite,    ///< nothing: (nx - 1) x (ny - 1) cells; rays through the side are lost and counted
};

/// A triangle of a cell. Lower holds the corner with the smaller y: for Diagonal::Anti that is
/// (i, j), (i+1, j), (i, j+1); for Diagonal::Main (i, j), (i+1, j), (i+1, j+1). Upper is the rest.
enum class Triangle : std::uint8_t { Lower = 0, Upper = 1 };

/// A microsurface: heights over a regular grid, two flat mirror triangles per cell.
///
/// heights[j * nx + i] is the height at x = i * dx, y = j * dy. Heights, dx and dy carry one unit
/// (`unit`, "cell" when the surface has no physical size). Row j = 0 is the first row of every file
/// format and the top row of every picture; y grows with j.
struct Heightfield {
    int nx = 0, ny = 0;
    double dx = 1, dy = 1;
    std::vector<float> heights;
    Diagonal diagonal = Diagonal::Anti;
    Boundary boundary = Boundary::Periodic;
    bool isotropic = false;     ///< declared: statistics do not depend on azimuth
    std::string unit = "cell";  ///< of heights, dx and dy: "cell" or "m"
    std::string name;           ///< where it comes from, one line
    std::string tiling;         ///< how a file was made to fill the plane; empty for made surfaces
    std::string source;         ///< what was found in the file and assumed; empty for made surfaces
    std::string prepared;       ///< what was done to it since, see prepare(); empty: nothing

    int cells_x() const { return boundary == Boundary::Periodic ? nx : nx - 1; }
    int cells_y() const { return boundary == Boundary::Periodic ? ny : ny - 1; }
    std::uint64_t cell_count() const {
        return static_cast<std::uint64_t>(cells_x()) * static_cast<std::uint64_t>(cells_y());
    }

    /// Height at sample (i, j), 0 <= i <= nx, 0 <= j <= ny: the last index wraps to the first.
    float at(int i, int j) const {
        const std::size_t column = static_cast<std::size_t>(i == nx ? 0 : i);
        const std::size_t row = static_cast<std::size_t>(j == ny ? 0 : j);
        return heights[row * static_cast<std::size_t>(nx) + column];
    }
};

/// Slope of a triangle: (dh/dx, dh/dy), without unit.
struct Slope {
    double x = 0, y = 0;
};

/// Slope of one triangle of cell (i, j), 0 <= i < cells_x(), 0 <= j < cells_y().
Slope facet_slope(const Heightfield& surface, int i, int j, Triangle triangle);

/// Unit normal of a facet of this slope; its z is positive.
inline Vec3 normal_of(Slope s) {
    return normalize({-s.x, -s.y, 1.0});
}

/// Distances of samples: beyond, single precision runs out of range.
inline constexpr double kLeastSpacing = 1e-15, kMostSpacing = 1e15;

/// Throws Error(InvalidInput, `where`) unless sizes fit, spacings are within their limits, there
/// are at least 2 x 2 samples and every height is finite. Cost: one pass over the heights.
void validate(const Heightfield& surface, const std::string& where);

/// Largest number of samples on a side.
inline constexpr int kMaxSurfaceSide = 32768;

}  // namespace asperity
