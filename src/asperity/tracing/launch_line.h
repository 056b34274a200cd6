// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/tracing/padded_heights.h>

#include <cstdint>
#include <vector>

namespace asperity {

/// The way of parallel rays that start at the same place of neighbouring cells, in free space.
///
/// They cross the same edges of the grid one after the other, each shifted by whole cells: so the
/// way is worked out once, in double precision, and serves a whole row of rays; heights come as
/// neighbours in memory. The way is a strip of rhombi as in wide_walk-inl.h, in rounds of kSteps
/// rhombi that are made when the first ray needs them.
class LaunchLine {
  public:
    static constexpr int kSteps = 8;
    /// Edges tested in a round: the one it begins at, and two for each step.
    static constexpr int kEdges = 1 + 2 * kSteps;

    /// A triangle that may be hit. Vertices are counted from the cell of the start.
    struct Triangle {
        std::int32_t x, y;  ///< corner O
        float side;         ///< as in FacetPoints
        float w, z;         ///< of the rays' line beside O, as in TriangleHits
    };
    struct Step {
        std::ptrdiff_t c, fresh;      ///< vertices to look up, as indices from the start's cell
        float z_c, z_fresh;           ///< height of the ray beside them
        std::int32_t right;           ///< all bits: C lies right of the ray
        float side_left, side_right;  ///< distances from the line of the ends of the side edge
        float w_a, w_b;               ///< and of the next edge (A, B)
    };
    struct Round {
        std::ptrdiff_t a, b;  ///< the edge it begins at
        float z_a, z_b, w_a, w_b;
        Step steps[kSteps];
        Triangle triangles[kEdges];  ///< what is hit when the edge of this number is below
        int lowest_x, lowest_y;      ///< no vertex of the round lies before this one
        float lowest_z;              ///< no ray of the round comes lower than this
    };
    /// A round reaches at most this far from its lowest vertex, in x and in y.
    static constexpr int kReach = kSteps + 3;

    /// Rays start at (u, v) in [0, 1) of their cell, at height `z`, in direction `d`, which is in
    /// units of length and in the frame of `heights`; d.x, d.y not both 0.
    LaunchLine(const PaddedHeights& heights, double u, double v, double z, Vec3 d);

    const Round& round(std::size_t k) {
        while (k >= rounds_.size()) add_round();
        return rounds_[k];
    }

    double du() const { return du_; }
    double dv() const { return dv_; }
    double k_x() const { return k_x_; }
    double k_y() const { return k_y_; }

  private:
    struct Vertex {
        int x, y;
        friend Vertex operator+(Vertex a, Vertex b) { return {a.x + b.x, a.y + b.y}; }
        friend Vertex operator-(Vertex a, Vertex b) { return {a.x - b.x, a.y - b.y}; }
    };
    double w(Vertex a) const { return du_ * (a.y - v_) - dv_ * (a.x - u_); }
    double z(Vertex a) const { return z_ + k_x_ * (a.x - u_) + k_y_ * (a.y - v_); }
    std::ptrdiff_t index(Vertex a) const { return static_cast<std::ptrdiff_t>(a.y) * pitch_ + a.x; }
    Triangle triangle(Vertex a, Vertex b, Vertex c) const;
    void add_round();

    int pitch_;
    double u_, v_, z_, du_, dv_, k_x_, k_y_;
    Vertex step_x_{}, step_y_{}, a_{};
    std::vector<Round> rounds_;
};

}  // namespace asperity
