// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/batch_sums.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

/// Cells put together, so that there are 32 x 64 blocks at most.
struct CoarseGrid {
    static constexpr std::size_t kMostRows = 32, kMostColumns = 64;

    explicit CoarseGrid(const SumShape& shape);

    std::size_t columns;        ///< of cells
    std::size_t height, width;  ///< cells a block; fewer in the last ones
    std::size_t down, across;   ///< blocks

    std::size_t blocks() const { return down * across; }
    std::size_t block_of(std::size_t cell) const {
        return cell / columns / height * across + cell % columns / width;
    }
};

/// Sums of a layer by groups of its batches, for the errors of what is told from several cells
/// (gonio/region.h): neighbours err together, which sums of squares of each do not know. Batch b
/// belongs to group b % 16, so the sums are the same in whatever order batches come.
struct GroupSums {
    static constexpr std::size_t kGroups = 16;

    GroupSums() = default;
    explicit GroupSums(const SumShape& shape);

    std::vector<std::uint64_t> rays;  ///< [group]
    /// Over all orders: [((group * sides + side) * blocks + block) * values + value].
    std::vector<std::uint64_t> energy;

    /// Adds what came to places in a row: energies[k] goes to `first` + k = place * values + value.
    /// `first` and their number are multiples of the values.
    void add(const SumShape& shape, std::size_t group, std::size_t first,
             std::span<const std::uint64_t> energies);
    /// Adds what counts[group] rays spread.
    void spread(const SumShape& shape, std::span<const std::uint64_t> counts,
                const SpreadLight& light);

    bool operator==(const GroupSums&) const = default;
};

}  // namespace asperity
