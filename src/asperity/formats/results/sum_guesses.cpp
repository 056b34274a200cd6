// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/sum_guesses.h>

#include <algorithm>

namespace asperity::io {

namespace {

/// Sums over all orders of numbers by `size` places.
template <class Number>
std::vector<std::uint64_t> over_orders(std::span<const Number> numbers, std::size_t size) {
    std::vector<std::uint64_t> sums(size);
    for (std::size_t begin = 0; size > 0 && begin < numbers.size(); begin += size)
        for (std::size_t k = 0; k < size; ++k) sums[k] += numbers[begin + k];
    return sums;
}

}  // namespace

SumGuesses::SumGuesses(const Layer& layer, std::span<const std::uint64_t> energy,
                       const SparedLayer& spared, const SumShape& shape)
    : layer_(layer),
      spared_(spared),
      shape_(shape),
      grid_(shape),
      batches_(std::max<std::uint64_t>(1, layer.spread.done.count())),
      paths_(over_orders(energy, shape.channels * shape.cells)),
      counts_(over_orders(std::span<const std::uint32_t>(spared.energy.paths), shape.cells)),
      of_block_(by_block(paths_)),
      count_of_block_(by_block(counts_)),
      known_of_block_(by_block(spared.known)) {
    const auto all = static_cast<double>(std::max<std::uint64_t>(1, layer.rays));
    const std::vector<std::uint64_t>& rays = layer.spread.groups.rays;
    for (std::size_t group = 0; group < rays.size(); ++group)
        shares_[group] = static_cast<double>(rays[group]) / all;
}

Wide SumGuesses::squares_of_known(std::size_t k) const {
    const std::uint64_t units = spared_.known[k];
    const Wide of_known = Wide{units} * units * spared_.known_squares;
    if (paths_[k] == 0) return of_known;
    const Wide energy = Wide{units} * spared_.known_unit;
    return of_known + 2 * energy * paths_[k] / batches_;
}

std::vector<double> SumGuesses::ratios_of_blocks(std::size_t channel) const {
    const std::size_t blocks = grid_.blocks();
    std::vector<double> ratios(blocks, -1);
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::uint64_t before =
            channel == 0 ? count_of_block_[block] : of_block_[(channel - 1) * blocks + block];
        if (before > 0)
            ratios[block] = static_cast<double>(of_block_[channel * blocks + block]) /
                            static_cast<double>(before);
    }
    return ratios;
}

std::vector<std::uint64_t> SumGuesses::by_block(std::span<const std::uint64_t> cells) const {
    const std::size_t columns = shape_.columns, rows = shape_.cells / columns;
    std::vector<std::size_t> across(columns);
    for (std::size_t column = 0; column < columns; ++column) across[column] = column / grid_.width;
    std::vector<std::uint64_t> sums(cells.size() / shape_.cells * grid_.blocks());
    for (std::size_t row = 0; row * columns < cells.size(); ++row) {
        // Of the channel and row of blocks that it lies in
        std::uint64_t* of_row =
            &sums[row / rows * grid_.blocks() + row % rows / grid_.height * grid_.across];
        const auto here = cells.subspan(row * columns, columns);
        for (std::size_t column = 0; column < columns; ++column)
            of_row[across[column]] += here[column];
    }
    return sums;
}

}  // namespace asperity::io
