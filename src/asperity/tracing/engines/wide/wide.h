// SPDX-License-Identifier: Apache-2.0
//
// What the wide tracer works on: thousands of paths at a time, one array per quantity, so that
// the lanes of a vector are neighbours in memory. docs/performance.md explains the design.
//
// Vertices of the grid are packed into 32 bits, x in the lower and y in the upper 16, counted from
// the middle of the surface, so that one instruction turns them into an index.
#pragma once

#include <cstddef>
#include <cstdint>

namespace asperity {

/// Paths in flight at a time: enough to keep the lanes full when most have left, few enough for
/// the second cache.
inline constexpr std::size_t kWave = 2048;

/// One value per path. The rest of the last vector, and a whole one more, may be overwritten.
template <class T>
struct alignas(64) PerPath {
    static constexpr std::size_t kSlack = 64;
    T values[kWave + kSlack] = {};
    T& operator[](std::size_t k) { return values[k]; }
    T operator[](std::size_t k) const { return values[k]; }
    operator T*() { return values; }
    operator const T*() const { return values; }
};

inline std::int32_t pack_vertex(int x, int y) {
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(y) << 16) |
                                     (static_cast<std::uint32_t>(x) & 0xffffu));
}
inline int vertex_x(std::int32_t packed) {
    return static_cast<std::int16_t>(packed & 0xffff);
}
inline int vertex_y(std::int32_t packed) {
    return packed >> 16;
}

/// A direction of travel, and whose it is: what is looked up together lies together.
struct Heading {
    float x, y, z;
    std::int32_t path;
};

/// Directions of travel, unit length, and what every step needs of them.
struct Directions {
    PerPath<float> x, y, z;
    PerPath<float> level;        ///< length of the horizontal part
    PerPath<std::int32_t> path;  ///< which path this is; stays the same through all bounces
    PerPath<Heading> headings;   ///< x, y, z, path once more, of paths that have set out
};

/// Points on facets. A facet is known by its right-angled corner O and by `side`: +1 for the lower
/// triangle O, O + (1, 0), O + (0, 1), -1 for the upper one O, O - (1, 0), O - (0, 1).
struct FacetPoints {
    std::size_t count = 0;
    PerPath<std::int32_t> corner;           ///< O
    PerPath<float> side;                    ///< +1, -1
    PerPath<float> u, v;                    ///< from O, in cells, along side * x and side * y
    PerPath<float> height, rise_u, rise_v;  ///< of O, and from there to the other two corners
    PerPath<float> x, y, z;                 ///< direction the path came along; not of parallel rays
    PerPath<std::int32_t> path;             ///< as in Directions; not of parallel rays
};

/// Paths under way between the facets; see wide_walk-inl.h.
struct Walkers {
    std::size_t count = 0;
    PerPath<std::int32_t> cell;
    PerPath<float> w, w_l, w_r;  ///< distance of the cell's left corner from the path's line; steps
    PerPath<float> z, z_l, z_r;  ///< height of the path beside that corner; steps
    PerPath<float> climb, level;  ///< of the direction: vertical and horizontal part
    PerPath<std::int32_t> sector, ray;
};

/// Paths that meet nothing any more: their directions, and for finite patches where they are, in
/// cells from the middle and in height.
struct Escapes {
    std::size_t count = 0;
    PerPath<float> x, y, z;
    PerPath<std::int32_t> path;
    PerPath<float> at_x, at_y, at_z;
};

/// The same while they are only known by their index into Directions.
struct Leavers {
    std::size_t count = 0;
    PerPath<std::int32_t> ray;
    PerPath<float> at_x, at_y, at_z;
};

}  // namespace asperity
