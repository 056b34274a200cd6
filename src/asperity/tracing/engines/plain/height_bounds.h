// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <cstddef>
#include <vector>

namespace asperity {

/// The highest point of square tiles of cells, in two sizes: a ray that passes above a tile's
/// highest point cannot meet anything in it.
///
/// A tile (a, b) of level k holds the cells [a * size, (a + 1) * size) x [b * size, ...), cut off
/// at the surface's last cell, with all four corners of each. Memory: 4 bytes per tile, (1/64 +
/// 1/4096) * 4 bytes per sample.
class HeightBounds {
  public:
    static constexpr int kLevels = 2;
    static constexpr int tile_size(int level) { return level == 0 ? 8 : 64; }

    HeightBounds(const Heightfield& surface, int threads);

    float max_height() const { return max_height_; }
    float tile_max(int level, int a, int b) const {
        const Level& l = levels_[level];
        return l.max[static_cast<std::size_t>(b) * static_cast<std::size_t>(l.nx) +
                     static_cast<std::size_t>(a)];
    }
    std::size_t memory_bytes() const;

  private:
    struct Level {
        int nx = 0, ny = 0;
        std::vector<float> max;
    };
    Level levels_[kLevels];
    float max_height_ = 0;
};

}  // namespace asperity
