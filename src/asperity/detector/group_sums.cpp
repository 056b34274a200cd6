// SPDX-License-Identifier: Apache-2.0
#include <asperity/detector/group_sums.h>

#include <algorithm>

namespace asperity {

namespace {

std::size_t rounded_up(std::size_t n, std::size_t by) {
    return (n + by - 1) / by;
}

}  // namespace

CoarseGrid::CoarseGrid(const SumShape& shape)
    : columns(shape.columns),
      height(std::max<std::size_t>(1, rounded_up(rounded_up(shape.cells, columns), kMostRows))),
      width(std::max<std::size_t>(1, rounded_up(columns, kMostColumns))),
      down(rounded_up(rounded_up(shape.cells, columns), height)),
      across(rounded_up(columns, width)) {}

GroupSums::GroupSums(const SumShape& shape)
    : rays(kGroups), energy(kGroups * shape.sides * CoarseGrid(shape).blocks() * shape.values()) {}

void GroupSums::add(const SumShape& shape, std::size_t group, std::size_t first,
                    std::span<const std::uint64_t> energies) {
    const CoarseGrid grid(shape);
    const std::size_t values = shape.values();
    // From one end of a block's row to the other, so that nothing is divided cell by cell
    const std::uint64_t* next = energies.data();
    std::size_t place = first / values;
    const std::size_t end = place + energies.size() / values;
    while (place < end) {
        const std::size_t cell = place % shape.cells, column = cell % grid.columns;
        const std::size_t in_block =
            std::min(grid.width - column % grid.width, grid.columns - column);
        const std::size_t count = std::min(in_block, end - place);
        const std::size_t side = place / shape.cells;
        std::uint64_t* sums =
            &energy[((group * shape.sides + side) * grid.blocks() + grid.block_of(cell)) * values];
        for (std::size_t n = 0; n < count; ++n)
            for (std::size_t v = 0; v < values; ++v) sums[v] += *next++;
        place += count;
    }
}

void GroupSums::spread(const SumShape& shape, std::span<const std::uint64_t> counts,
                       const SpreadLight& light) {
    // What one ray brings to each block is the same for all groups
    const std::size_t values = shape.values();
    std::vector<std::uint64_t> of_ray(energy.size() / kGroups);
    const CoarseGrid grid(shape);
    for (std::size_t p = 0; p < light.places.size(); ++p) {
        const std::size_t side = light.places[p] / shape.cells;
        const std::size_t block = grid.block_of(light.places[p] % shape.cells);
        for (std::size_t v = 0; v < values; ++v)
            of_ray[(side * grid.blocks() + block) * values + v] += light.energy[p * values + v];
    }
    for (std::size_t group = 0; group < counts.size(); ++group)
        for (std::size_t k = 0; k < of_ray.size(); ++k)
            energy[group * of_ray.size() + k] += counts[group] * of_ray[k];
}

}  // namespace asperity
