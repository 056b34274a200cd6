// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>
#include <asperity/tracing/engines/plain/tracer.h>
#include <asperity/tracing/engines/wide/padded_heights.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace asperity {

/// The way of parallel rays over the surface as seen from above: a line along the light, and with
/// it all lines that lie beside it by whole cells.
///
/// They cross the same edges of the grid one after the other, each shifted by whole cells: so the
/// way is worked out once, in double precision, and serves all lines; heights come as neighbours in
/// memory. Many rays follow a line, one behind the other: each meets the surface at the first edge
/// that carries it above the ray (docs/performance.md, "Light in lines"). Of the three kinds of
/// edges, columns, rows and diagonals, a line crosses one as often as the other two together; two
/// neighbouring ones of that kind with what lies between are a rhombus, so the way is a strip of
/// rhombi: an edge (A, B) of that kind, a side edge, the next (A', B') ... It comes in rounds of
/// kSteps rhombi that are made when the first line needs them.
class LaunchLine {
  public:
    static constexpr int kSteps = 8;
    /// Edges of a round: the one it begins at, and two for each step.
    static constexpr int kEdges = 1 + 2 * kSteps;
    /// Rays that have not landed after so many rounds do not end, as those that cross
    /// Tracer::kMaxCrossings lines: some 50 MB.
    static constexpr std::size_t kMostRounds = Tracer::kMaxCrossings / (2 * kSteps);

    /// A triangle that may be hit. Vertices are counted from the cell of the start.
    struct Triangle {
        std::int32_t corner;  ///< O, packed
        float side;           ///< as in FacetPoints
        float w;              ///< distance of O from the line, positive on the left
        float sunk;           ///< how much a ray has sunk beside O since the round began
    };
    /// An edge between two vertices on either side of the line, as indices from the first vertex of
    /// its round. A ray that enters the round below height(left) * share_left + height(right) *
    /// share_right + sunk is below the surface at the edge.
    struct Edge {
        std::int32_t left, right;
        float share_left, share_right, sunk;
    };
    /// The cell of a triangle, counted from the lowest vertex of its round: the start's cell may be
    /// further away than 16 bits can tell.
    struct Cell {
        std::int16_t x, y;
        std::int32_t upper;  ///< 1 for the upper triangle, 0 for the lower one
    };
    struct Round {
        Edge edges[kEdges];
        Cell cells[kEdges];      ///< of the triangles before the edges
        int first_x, first_y;    ///< the first vertex, counted likewise
        int lowest_x, lowest_y;  ///< no vertex of the round lies before this one, counted likewise
        double z;                ///< of the ray that starts where the line does, as it enters
        float sunk;              ///< how much a ray sinks in the round
    };
    /// A round reaches at most this far from its lowest vertex, in x and in y.
    static constexpr int kReach = kSteps + 1;
    static constexpr int kSwappedPitch = 48;

    /// Whether lines of light along `d`, not straight down, lie beside each other in y: it crosses
    /// more columns of cells of dx x dy than rows.
    static bool along_x(const Vec3& d, double dx, double dy) {
        return std::abs(d.x) / dx > std::abs(d.y) / dy;
    }
    /// Begins a new line at (u, v) in [0, 1] of a cell in direction `d`, d.z < 0, which is in units
    /// of length and in the frame of `heights`; d.x, d.y not both 0. The first ray starts at height
    /// `z`. If `swapped`, x and y change places, but for triangles, and rows are kSwappedPitch
    /// long.
    void start(const PaddedHeights& heights, bool swapped, double u, double v, double z, Vec3 d);

    const Round& round(std::size_t k) {
        while (k >= rounds_.size()) add_round();
        return rounds_.data()[k];
    }
    /// triangles()[k * kEdges + edge]: the one before an edge of round k, which is hit when the
    /// edge is the first below the surface; of the rounds asked for.
    const Triangle* triangles() const { return triangles_.data(); }
    bool swapped() const { return swapped_; }
    /// Whether it goes towards larger y, or x if it is swapped.
    bool goes_up() const { return dv_ > 0; }

  private:
    /// A vertex, or a step between two, counted from the cell of the start: its distance from the
    /// line and the height of the first ray beside it, or by how much these grow.
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
    /// A triangle of a rhombus: its corner O seen from A.
    struct Half {
        Vertex corner;
        bool upper;
    };
    Half half(const Vertex& third) const;
    /// `per_width`: 1 over what the distances of left and right from the line differ by.
    Edge edge(const Round& round, const Vertex& left, const Vertex& right, double per_width) const;
    void add_round();

    bool swapped_ = false;
    int pitch_ = 0;
    double du_ = 0, dv_ = 0, k_x_ = 0, k_y_ = 0;
    Vertex step_x_{}, step_y_{}, step_ab_{}, a_{};
    Half first_{}, second_{};  ///< of a rhombus, before and behind the edge (A, B)
    std::vector<Round> rounds_;
    std::vector<Triangle> triangles_;
};

}  // namespace asperity
