// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/tile_heights.h>

#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace asperity::io {
namespace {

// Sample of a patch of n that stands at place k of its mirrored row of 2 n - 2.
std::size_t reflected(std::size_t k, std::size_t n) {
    return k < n ? k : 2 * n - 2 - k;
}

}  // namespace

Heightfield mirrored(const Heightfield& patch) {
    Heightfield tile;
    tile.nx = 2 * patch.nx - 2;
    tile.ny = 2 * patch.ny - 2;
    if (tile.nx > kMaxSurfaceSide || tile.ny > kMaxSurfaceSide)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("mirrored it has {} x {} samples, {} on a side are allowed: use "
                                "tiling periodic or finite",
                                tile.nx, tile.ny, kMaxSurfaceSide),
                    patch.name);
    tile.dx = patch.dx;
    tile.dy = patch.dy;
    tile.diagonal = patch.diagonal;
    tile.boundary = Boundary::Periodic;
    tile.isotropic = patch.isotropic;
    tile.unit = patch.unit;
    tile.name = patch.name;
    tile.source = patch.source;
    tile.prepared = patch.prepared;

    const auto nx = static_cast<std::size_t>(patch.nx), ny = static_cast<std::size_t>(patch.ny);
    tile.heights.reserve((2 * nx - 2) * (2 * ny - 2));
    for (std::size_t j = 0; j < 2 * ny - 2; ++j)
        for (std::size_t i = 0; i < 2 * nx - 2; ++i)
            tile.heights.push_back(patch.heights[reflected(j, ny) * nx + reflected(i, nx)]);
    return tile;
}

bool edges_fit(const Heightfield& surface) {
    constexpr double kSpare = 1.1;
    const auto nx = static_cast<std::size_t>(surface.nx), ny = static_cast<std::size_t>(surface.ny);
    // Sum of squared steps from column i to the next, from row j to the next; the last to the first
    std::vector<double> columns(nx), rows(ny);
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const double h = double{surface.heights[j * nx + i]};
            const double right = double{surface.heights[j * nx + (i + 1) % nx]} - h;
            const double down = double{surface.heights[(j + 1) % ny * nx + i]} - h;
            columns[i] += right * right;
            rows[j] += down * down;
        }
    const auto fits = [](const std::vector<double>& squares) {
        const double largest = *std::max_element(squares.begin(), squares.end() - 1);
        return squares.back() <= kSpare * kSpare * largest;
    };
    return fits(columns) && fits(rows);
}

}  // namespace asperity::io
