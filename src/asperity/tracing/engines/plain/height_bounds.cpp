// SPDX-License-Identifier: Apache-2.0
#include <asperity/tracing/engines/plain/height_bounds.h>

#include <asperity/core/parallel.h>

#include <algorithm>
#include <limits>

namespace asperity {

namespace {

/// Highest corner of the cells [i0, i1) x [j0, j1).
float highest_corner(const Heightfield& s, int i0, int i1, int j0, int j1) {
    float highest = -std::numeric_limits<float>::infinity();
    for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) highest = std::max(highest, s.at(i, j));
    return highest;
}

}  // namespace

HeightBounds::HeightBounds(const Heightfield& surface, int threads) {
    const int cells_x = surface.cells_x(), cells_y = surface.cells_y();
    for (int k = 0; k < kLevels; ++k) {
        Level& level = levels_[k];
        level.nx = (cells_x + tile_size(k) - 1) / tile_size(k);
        level.ny = (cells_y + tile_size(k) - 1) / tile_size(k);
        level.max.resize(static_cast<std::size_t>(level.nx) * static_cast<std::size_t>(level.ny));
    }

    // Fine tiles from the heights
    Level& fine = levels_[0];
    parallel_for(static_cast<std::size_t>(fine.ny), threads, [&](std::size_t row) {
        const int j0 = static_cast<int>(row) * tile_size(0);
        const int j1 = std::min(j0 + tile_size(0), cells_y);
        for (int a = 0; a < fine.nx; ++a) {
            const int i0 = a * tile_size(0), i1 = std::min(i0 + tile_size(0), cells_x);
            fine.max[row * static_cast<std::size_t>(fine.nx) + static_cast<std::size_t>(a)] =
                highest_corner(surface, i0, i1, j0, j1);
        }
    });

    // Coarse tiles from the fine ones
    Level& coarse = levels_[1];
    std::fill(coarse.max.begin(), coarse.max.end(), -std::numeric_limits<float>::infinity());
    constexpr int kRatio = tile_size(1) / tile_size(0);
    for (int b = 0; b < fine.ny; ++b)
        for (int a = 0; a < fine.nx; ++a) {
            float& highest = coarse.max[static_cast<std::size_t>(b / kRatio) *
                                            static_cast<std::size_t>(coarse.nx) +
                                        static_cast<std::size_t>(a / kRatio)];
            highest = std::max(highest, tile_max(0, a, b));
        }
    max_height_ = *std::max_element(coarse.max.begin(), coarse.max.end());
}

std::size_t HeightBounds::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Level& level : levels_) bytes += level.max.size() * sizeof(float);
    return bytes;
}

}  // namespace asperity
