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
/// neighbours in memory. The edges are tested as in wide_walk-inl.h. Of the three kinds of edges,
/// columns, rows and diagonals, a ray crosses one as often as the other two together; two
/// neighbouring ones of that kind with what lies between are a rhombus, so the way is a strip of
/// rhombi: an edge (A, B) of that kind, a side edge, the next (A', B') ... It comes in rounds of
/// kSteps rhombi that are made when the first ray needs them.
class LaunchLine {
  public:
    static constexpr int kSteps = 8;
    /// Edges tested in a round: the one it begins at, and two for each step.
    static constexpr int kEdges = 1 + 2 * kSteps;

    /// A triangle that may be hit. Vertices are counted from the cell of the start.
    struct Triangle {
        std::int32_t corner;  ///< O, packed
        float side;           ///< as in FacetPoints
        float w, z;           ///< of the rays' line beside O, as in ParallelHits
    };
    /// An edge between two vertices on either side of the rays, as indices from the first vertex of
    /// its round. The surface there rises above a ray just when
    /// height(left) * w_right - height(right) * w_left < limit, see wide_walk-inl.h.
    struct Edge {
        std::int32_t left, right;
        float w_left, w_right, limit;
    };
    struct Round {
        Edge edges[kEdges];
        int first_x, first_y;    ///< the first vertex, counted from the start's cell
        int lowest_x, lowest_y;  ///< no vertex of the round lies before this one, counted likewise
        int rows;                ///< of vertices
        float lowest_z;          ///< no ray of the round comes lower than this
    };
    /// A round reaches at most this far from its lowest vertex, in x and in y.
    static constexpr int kReach = kSteps + 1;

    /// Begins a new line. Rays start at (u, v) in [0, 1] of their cell, at height `z`, in direction
    /// `d`, which is in units of length and in the frame of `heights`; d.x, d.y not both 0.
    void start(const PaddedHeights& heights, double u, double v, double z, Vec3 d);

    const Round& round(std::size_t k) {
        while (k >= rounds_.size()) add_round();
        return rounds_.data()[k];
    }
    /// triangles()[k * kEdges + edge]: what is hit when this edge of round k is the first below the
    /// surface; of the rounds asked for.
    const Triangle* triangles() const { return triangles_.data(); }

    double du() const { return du_; }
    double dv() const { return dv_; }
    double k_x() const { return k_x_; }
    double k_y() const { return k_y_; }

  private:
    /// A vertex, or a step between two, counted from the cell of the start: its distance from the
    /// rays' line and the height of the rays beside it, or by how much these grow.
    struct Vertex {
        std::int32_t x, y;
        double w, z;
        friend Vertex operator+(const Vertex& a, const Vertex& b) {
            return {a.x + b.x, a.y + b.y, a.w + b.w, a.z + b.z};
        }
        friend Vertex operator-(const Vertex& a, const Vertex& b) {
            return {a.x - b.x, a.y - b.y, a.w - b.w, a.z - b.z};
        }
    };
    Vertex step(int x, int y) const { return {x, y, du_ * y - dv_ * x, k_x_ * x + k_y_ * y}; }
    Edge edge(const Round& round, const Vertex& left, const Vertex& right) const {
        const auto index = [&](const Vertex& v) {
            return (v.y - round.first_y) * pitch_ + (v.x - round.first_x);
        };
        return {index(left), index(right), static_cast<float>(left.w), static_cast<float>(right.w),
                static_cast<float>(left.z * right.w - right.z * left.w)};
    }
    void add_triangle(const Vertex& a, const Vertex& b, const Vertex& c);
    void add_round();

    int pitch_ = 0;
    double z_ = 0, du_ = 0, dv_ = 0, k_x_ = 0, k_y_ = 0;
    Vertex step_x_{}, step_y_{}, a_{};
    std::vector<Round> rounds_;
    std::vector<Triangle> triangles_;
};

}  // namespace asperity
