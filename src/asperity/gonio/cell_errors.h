// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

/// Errors of figures that are told from several cells of a layer at once: of sums of energies, each
/// times a weight, and so of whatever changes with the energies as such a sum does.
///
/// Cells beside each other err together, and the channels of a ray do. What is known of it are sums
/// over 32 x 64 blocks of cells by 16 groups of batches, which results keep. A block's cells follow
/// the block in proportion; what the weights of one block differ from their mean counts by the
/// errors of the cells, taken as alike as cells within blocks are in the mean over the layer, and
/// all channels of a cell as one. What analytically solved facets bring grows and shrinks together,
/// and against the light that is followed: that is counted apart, as if rays met either by chance.
/// Up to 64 columns a block is a cell, and all is told from batches.
/// Holds what it needs of the measurement. Cost: some operations a block, group, channel and cell.
/// Source: docs/theory.md, "Sums of cells".
class CellErrors {
  public:
    /// Whether the layer holds what errors of several cells come from; results of older versions
    /// do not.
    static bool known(const Layer& layer) {
        return !layer.spread.groups.rays.empty() && !layer.stderr_energy.empty();
    }

    /// Of a layer of which they are known.
    CellErrors(const Measurement& measurement, const Layer& layer);

    /// Measurement::energies of all channels, [channel * cells + cell].
    const std::vector<double>& energies() const { return energy_; }

    /// Standard error of what several cells of a channel hold together, each named once. Cost: some
    /// operations a cell and, for each block that they touch, a group.
    double error_of_cells(std::size_t channel, std::span<const int> cells) const;

    /// Standard error of the sum of weights[k] * energy[k], k = channel * cells + cell, energies as
    /// fractions of what was launched. Infinite for a single batch. Throws Error(Usage) for another
    /// number of weights.
    double error(std::span<const double> weights) const;

    /// Covariances of several such sums, [i * sums + j].
    std::vector<double> covariances(std::span<const std::vector<double>> weights) const;

  private:
    static constexpr std::size_t kGroups = GroupSums::kGroups;

    template <class Work>
    void for_blocks(Work work) const;
    std::array<double, kGroups> group_sums(std::span<const double> weights,
                                           std::vector<double>& of_parts) const;
    double covariance(const std::array<double, kGroups>& a,
                      const std::array<double, kGroups>& b) const;
    double likeness(std::size_t channel) const;
    void find_known(const Layer& layer);

    CoarseGrid grid_;
    std::size_t channels_, cells_;
    std::array<double, kGroups> rays_{};
    double all_rays_ = 0;
    int groups_ = 0;                       ///< that have rays
    std::vector<std::uint32_t> block_of_;  ///< [cell]
    std::vector<double> group_energy_;  ///< [(channel * blocks + block) * groups + group], in rays
    std::vector<double> energy_;        ///< [channel * cells + cell]
    std::vector<double> block_energy_;  ///< [channel * blocks + block]
    std::vector<double> error_;         ///< of a cell, so alike as they are in a block; as energy_
    std::vector<double> block_square_;  ///< sum of the squares of error_, as block_energy_
    std::vector<double> known_;         ///< what one sigma more of solved light brings, as energy_
};

}  // namespace asperity
