// SPDX-License-Identifier: Apache-2.0
#pragma once

// Trees of averages over cubes of directions, as Radiance writes them; inside this folder only.

#include <asperity/core/vec.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// A place on the unit square for a point of the unit disk and back, with areas in proportion
/// (Shirley and Chiu 1997).
struct SquarePoint {
    double u = 0, v = 0;
};
SquarePoint disk_to_square(double x, double y);
Vec3 hemisphere_of_square(SquarePoint s);  ///< z >= 0 above that point of the disk

/// Coordinates in [0, 1] of a pair of directions. Rank 4: the square of -wi, then that of wo. Rank
/// 3: (1 - sin theta_i) / 2, then the square of wo turned so that -wi has azimuth 0.
std::array<double, 4> tree_coordinates(int rank, Vec3 wi, Vec3 wo);
/// A pair of directions with these coordinates.
struct TreeDirections {
    Vec3 wi, wo;
};
TreeDirections tree_directions(int rank, const std::array<double, 4>& coordinates);

/// A value a cube of the unit cube of `rank` dimensions.
class TensorTree {
  public:
    /// From a full grid of 2^levels values a side, the first coordinate slowest: cubes whose values
    /// differ by less than `tolerance` of the largest of them become one.
    /// `between` is called between nodes, and may throw.
    TensorTree(int rank, int levels, const std::vector<double>& grid, double tolerance,
               std::function<void()> between = {});
    /// From the text of nested braces. Throws Error(InvalidInput, where).
    TensorTree(int rank, std::string_view text, const std::string& where);

    double at(const std::array<double, 4>& coordinates) const;
    std::string text(const std::function<void()>& between = {}) const;
    std::size_t nodes() const { return nodes_.size(); }

  private:
    struct Node {
        int levels = -1;                  ///< of a leaf: 2^levels values a side; -1: a branch
        std::vector<std::size_t> branch;  ///< children; bit i: the upper half of coordinate i
        std::vector<double> values;       ///< the first coordinate slowest
    };
    std::size_t build(int levels, const std::vector<double>& grid, int grid_levels,
                      std::array<std::size_t, 4> corner, double tolerance,
                      const std::function<void()>& between);
    std::size_t parse(std::string_view text, std::size_t& at, int depth, const std::string& where);
    void append_text(std::size_t node, std::string& text,
                     const std::function<void()>& between) const;

    int rank_;
    std::vector<Node> nodes_;
    std::size_t root_ = 0;
};

}  // namespace asperity::io
