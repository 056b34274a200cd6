// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/rest_coding.h>
#include <asperity/formats/results/spared_layer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity::io {

/// What the sums of a layer that its errors come from are guessed from: of a channel from the one
/// before, and of the first one from numbers of paths.
class SumGuesses {
  public:
    /// `energy` is that of paths, like Layer::energy.
    SumGuesses(const Layer& layer, std::span<const std::uint64_t> energy, const SparedLayer& spared,
               const SumShape& shape);

    const CoarseGrid& grid() const { return grid_; }
    /// By channel and cell, over all orders.
    const std::vector<std::uint64_t>& energy() const { return paths_; }
    const std::vector<std::uint64_t>& energy_of_blocks() const { return of_block_; }
    const std::vector<std::uint64_t>& known_of_blocks() const { return known_of_block_; }
    /// By cell, and by block.
    const std::vector<std::uint64_t>& counts() const { return counts_; }
    const std::vector<std::uint64_t>& counts_of_blocks() const { return count_of_block_; }

    /// The part of a cell's squares that known facets have to do with.
    Wide known_squares(std::size_t k) const {
        return spared_.known.empty() || spared_.known[k] == 0 ? 0 : squares_of_known(k);
    }
    /// Likewise for the energy of a group in a block of cells.
    std::uint64_t known_of_group(std::size_t group, std::size_t channel, std::size_t block) const {
        return known_of_block_.empty() ? 0
                                       : spared_.known_of_group[group] *
                                             known_of_block_[channel * grid_.blocks() + block];
    }

    /// Of numbers of paths.
    std::uint64_t path_squares(std::size_t cell) const {
        const std::uint32_t reached = layer_.spread.reached[cell];
        return reached == 0 ? 0 : counts_[cell] * counts_[cell] / reached;
    }
    std::uint64_t path_group(std::size_t group, std::size_t block) const {
        return whole64(static_cast<double>(count_of_block_[block]) * shares_[group]);
    }

    /// Calls work(k, known, guess) for all squares in order, which gives what is right, both
    /// without the known part. Empty `path_squares` are not told.
    template <class Work>
    void for_squares(std::span<const std::uint64_t> path_squares, Work work) const {
        for_cells(path_squares, [&](std::size_t k, Wide before) {
            return work(k, known_squares(k), squares(k, before));
        });
    }
    /// Likewise for halves, work(k, guess).
    template <class Work>
    void for_halves(std::span<const std::uint64_t> path_halves, Work work) const {
        for_cells(path_halves,
                  [&](std::size_t k, Wide before) { return work(k, from_before(k, before)); });
    }

    /// Calls work(place among SparedLayer::groups, place among GroupSums::energy, known, guess) for
    /// all groups in order, which gives what is right, both without the known part.
    template <class Work>
    void for_groups(std::span<const std::uint64_t> path_groups, Work work) const {
        const std::size_t blocks = grid_.blocks();
        std::vector<std::uint64_t> before(path_groups.begin(), path_groups.end());
        before.resize(GroupSums::kGroups * blocks);
        for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
            const std::vector<double> ratios = ratios_of_blocks(channel);
            std::vector<std::uint64_t> others(blocks);
            for (std::size_t group = 0; group < GroupSums::kGroups; ++group)
                for (std::size_t block = 0; block < blocks; ++block) {
                    const std::size_t k = group * blocks + block;
                    const std::uint64_t guess =
                        group + 1 == GroupSums::kGroups
                            ? of_block_[channel * blocks + block] - others[block]
                            : of_group(group, channel * blocks + block, before[k], ratios[block]);
                    before[k] = work(channel * GroupSums::kGroups * blocks + k,
                                     k * shape_.channels + channel,
                                     known_of_group(group, channel, block), guess);
                    others[block] += before[k];
                }
        }
    }

  private:
    template <class Work>
    void for_cells(std::span<const std::uint64_t> of_paths, Work work) const {
        std::vector<Wide> before(of_paths.begin(), of_paths.end());
        before.resize(shape_.cells);
        for (std::size_t k = 0; k < paths_.size(); ++k) {
            Wide& here = before[k % shape_.cells];
            here = work(k, here);
        }
    }

    /// What stands before a channel: the one before, or numbers of paths.
    std::uint64_t energy_before(std::size_t k) const {
        return k < shape_.cells ? counts_[k] : paths_[k - shape_.cells];
    }
    Wide squares_of_known(std::size_t k) const;
    /// Squares grow as those of the energy; 0 if there is none before.
    Wide from_before(std::size_t k, Wide before) const {
        const std::uint64_t energy = energy_before(k);
        if (energy == 0 || before == 0) return 0;
        const double ratio = static_cast<double>(paths_[k]) / static_cast<double>(energy);
        return whole(static_cast<double>(as_signed(before)) * ratio * ratio);
    }
    Wide squares(std::size_t k, Wide before) const {
        const std::uint32_t reached = layer_.spread.reached[k];
        if (reached == 0) return 0;
        const Wide energy = paths_[k];
        if (reached == 1) return energy * energy;
        return energy_before(k) == 0 ? energy * energy / reached : from_before(k, before);
    }
    /// Energy of a block for each unit of what stands before it; below 0 if that is nothing.
    std::vector<double> ratios_of_blocks(std::size_t channel) const;
    std::uint64_t of_group(std::size_t group, std::size_t k, std::uint64_t before,
                           double ratio) const {
        return whole64(ratio < 0 ? static_cast<double>(of_block_[k]) * shares_[group]
                                 : static_cast<double>(as_signed(before)) * ratio);
    }
    /// By so many channels and blocks; empty if there are none.
    std::vector<std::uint64_t> by_block(std::span<const std::uint64_t> cells) const;

    const Layer& layer_;
    const SparedLayer& spared_;
    const SumShape& shape_;
    CoarseGrid grid_;
    std::uint64_t batches_;
    std::array<double, GroupSums::kGroups> shares_{};  ///< of all rays
    std::vector<std::uint64_t> paths_, counts_, of_block_, count_of_block_, known_of_block_;
};

}  // namespace asperity::io
