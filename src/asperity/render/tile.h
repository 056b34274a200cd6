// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/render/wave.h>

#include <cstdint>
#include <span>

namespace asperity {

/// Side of a tile [pixels].
inline constexpr int kTileSide = 16;

/// A rectangle of pixels.
struct Tile {
    int x = 0, y = 0, width = 0, height = 0;

    std::uint64_t pixels() const {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};

/// Tiles of a picture, counted row by row.
struct TileGrid {
    int width = 0, height = 0;  ///< of the picture

    int columns() const { return (width + kTileSide - 1) / kTileSide; }
    int rows() const { return (height + kTileSide - 1) / kTileSide; }
    std::size_t count() const {
        return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
    }
    Tile tile(std::size_t k) const;
};

/// Takes sample `sample` of the pixels of a tile that have not got it yet and adds it to the film:
/// of all, or of those alone whose entry in `chosen`, row by row of the film, is not 0. Returns how
/// many they were.
std::uint64_t render_tile(const View& view, const Tile& tile, std::uint32_t sample,
                          std::span<const std::uint8_t> chosen, Film& film, RayCounts& counts);

}  // namespace asperity
