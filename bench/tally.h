// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace asperity::bench {

/// The cells all rivals sort into: those of an equal-area detector of resolution 64. Competitors
/// sort with this, in single precision and without atan2, so that they lose no time here.
class DirectionCells {
  public:
    static constexpr int kRows = 32, kColumns = 64;
    static constexpr int kCells = kRows * kColumns;

    DirectionCells();

    /// Cell of the unit vector (x, y, z >= 0).
    int cell_of(float x, float y) const {
        const int row = std::min(static_cast<int>((x * x + y * y) * kRows), kRows - 1);
        // y over |x| + |y|, unfolded, grows with the azimuth from 0 to 4
        const float p = y / std::max(std::abs(x) + std::abs(y), std::numeric_limits<float>::min());
        const float turned = x < 0 ? 2 - p : (y < 0 ? 4 + p : p);
        const int step = std::min(static_cast<int>(turned * (kSteps / 4)), kSteps - 1);
        // A step holds one edge between columns at most
        const Guess& g = guesses_[static_cast<std::size_t>(step)];
        const bool past = g.edge_x * y - g.edge_y * x >= 0;
        return row * kColumns + g.column + static_cast<int>(past);
    }

  private:
    static constexpr int kSteps = 256;
    /// Column at the lower end of a step, and the direction of that column's upper edge.
    struct Guess {
        float edge_x, edge_y;
        int column;
    };
    std::array<Guess, kSteps> guesses_;
};

/// What came out: the same bookkeeping for all rivals, so that their times compare.
class Tally {
  public:
    Tally() : histogram_(DirectionCells::kCells) {}

    /// A path left along the unit vector (x, y, z) after `bounces` reflections.
    void add_escape(const DirectionCells& cells, float x, float y, int bounces) {
        add_escapes(cells.cell_of(x, y), 1);
        add_reflections(static_cast<std::uint64_t>(bounces));
    }
    /// Rays may be spread over cells.
    void add_escapes(int cell, double count) {
        histogram_[static_cast<std::size_t>(cell)] += count;
        escaped_ += count;
    }
    /// `count` paths of `bounces` reflections in all would have needed one more.
    void add_truncated(double count, std::uint64_t bounces) {
        truncated_ += count;
        reflections_ += bounces;
    }
    /// Paths that fell through a seam of the mesh, or never ended.
    void add_lost(std::uint64_t count = 1) { lost_ += count; }
    void add_segments(std::uint64_t count) { segments_ += count; }
    void add_reflections(std::uint64_t count) { reflections_ += count; }

    std::uint64_t segments() const { return segments_; }
    double escaped() const { return escaped_; }
    double truncated() const { return truncated_; }
    std::uint64_t lost() const { return lost_; }
    std::uint64_t reflections() const { return reflections_; }
    double paths() const { return escaped_ + truncated_ + static_cast<double>(lost_); }
    /// Share of all paths that left into a cell.
    double share(std::size_t cell) const { return histogram_[cell] / paths(); }

  private:
    std::vector<double> histogram_;
    double escaped_ = 0, truncated_ = 0;
    std::uint64_t segments_ = 0, lost_ = 0, reflections_ = 0;
};

/// How far two runs that followed the same launch points are apart, half the L1 distance of their
/// histograms, in units of what runs with independent points would show: far below 1, as only paths
/// next to an edge may part.
double disagreement_of_same_points(const Tally& a, const Tally& b);

/// How far two rivals with launch points of their own are apart, as half the L1 distance of their
/// mean histograms, in units of what the spread of their repetitions lets expect: about 1. Not a
/// number with fewer than two repetitions.
double disagreement_of_own_points(const std::vector<Tally>& a, const std::vector<Tally>& b);

}  // namespace asperity::bench
