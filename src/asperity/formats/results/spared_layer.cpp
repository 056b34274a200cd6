// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/spared_layer.h>

#include <asperity/gonio/layer_of_sums.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>

namespace asperity::io {

namespace {

using Wide = LayerSums::Wide;
__extension__ using SignedWide = __int128;

/// Numbers around 0 as small ones without a sign: 0, -1, 1, -2 ...
std::uint64_t folded(std::uint64_t x) {
    return (x << 1) ^ (0 - (x >> 63));
}
std::uint64_t unfolded(std::uint64_t x) {
    return (x >> 1) ^ (0 - (x & 1));
}
Wide folded(Wide x) {
    return (x << 1) ^ (0 - (x >> 127));
}
Wide unfolded(Wide x) {
    return (x >> 1) ^ (0 - (x & 1));
}

/// The nearest whole number towards 0; 0 where there is none of so many bits.
Wide whole(double x) {
    return std::abs(x) < 0x1p126 ? static_cast<Wide>(static_cast<SignedWide>(x)) : 0;
}
std::uint64_t whole64(double x) {
    return std::abs(x) < 0x1p62 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(x)) : 0;
}

/// Energies by channel and cell that paths brought, over all orders; the layer's are those.
std::vector<std::uint64_t> over_orders(std::span<const std::uint64_t> energy, std::size_t size) {
    std::vector<std::uint64_t> sums(size);
    for (std::size_t begin = 0; size > 0 && begin < energy.size(); begin += size)
        for (std::size_t k = 0; k < size; ++k) sums[k] += energy[begin + k];
    return sums;
}

/// What squares and groups of batches are guessed from.
class Guess {
  public:
    Guess(const Layer& layer, std::span<const std::uint64_t> energy, const SparedLayer& spared,
          const SumShape& shape)
        : layer_(layer),
          spared_(spared),
          shape_(shape),
          grid_(shape),
          batches_(std::max<std::uint64_t>(1, layer.spread.done.count())),
          paths_(over_orders(energy, shape.channels * shape.cells)),
          of_block_(by_block(paths_)),
          known_of_block_(by_block(spared.known)) {}

    const CoarseGrid& grid() const { return grid_; }

    /// The part of a cell's squares that known facets have to do with.
    Wide known_squares(std::size_t k) const {
        if (spared_.known.empty() || spared_.known[k] == 0) return 0;
        const std::uint64_t units = spared_.known[k];
        const Wide of_known = Wide{units} * units * spared_.known_squares;
        if (paths_[k] == 0) return of_known;
        const Wide energy = Wide{units} * spared_.known_unit;
        return of_known + 2 * energy * paths_[k] / batches_;
    }
    /// The part of paths; `before` is that of the channel before.
    Wide squares(std::size_t k, Wide before) const {
        const std::uint32_t reached = layer_.spread.reached[k];
        if (reached == 0) return 0;
        const Wide energy = paths_[k];
        if (reached == 1) return energy * energy;
        if (k < shape_.cells || paths_[k - shape_.cells] == 0) return energy * energy / reached;
        const double ratio =
            static_cast<double>(paths_[k]) / static_cast<double>(paths_[k - shape_.cells]);
        return whole(static_cast<double>(static_cast<SignedWide>(before)) * ratio * ratio);
    }

    /// Likewise for the energy of a group in a block of cells.
    std::uint64_t known_of_group(std::size_t group, std::size_t channel, std::size_t block) const {
        return known_of_block_.empty() ? 0
                                       : spared_.known_of_group[group] *
                                             known_of_block_[channel * grid_.blocks() + block];
    }
    /// `before` is that of the channel before, `others` what the groups before this one have.
    std::uint64_t of_group(std::size_t group, std::size_t channel, std::size_t block,
                           std::uint64_t before, std::uint64_t others) const {
        const std::size_t k = channel * grid_.blocks() + block;
        if (group + 1 == GroupSums::kGroups) return of_block_[k] - others;
        const auto all = static_cast<double>(of_block_[k]);
        if (channel > 0 && of_block_[k - grid_.blocks()] > 0)
            return whole64(static_cast<double>(static_cast<std::int64_t>(before)) *
                           (all / static_cast<double>(of_block_[k - grid_.blocks()])));
        const auto rays = static_cast<double>(std::max<std::uint64_t>(1, layer_.rays));
        return whole64(all * (static_cast<double>(layer_.spread.groups.rays[group]) / rays));
    }

    /// Calls work(k, guess) for all squares in order, which gives what is right.
    template <class Work>
    void for_squares(Work work) const {
        std::vector<Wide> paths(shape_.channels * shape_.cells);
        for (std::size_t k = 0; k < paths.size(); ++k) {
            const Wide known = known_squares(k);
            const Wide before = k < shape_.cells ? 0 : paths[k - shape_.cells];
            paths[k] = work(k, known + squares(k, before)) - known;
        }
    }

    /// Calls work(place among SparedLayer::groups, place among GroupSums::energy, guess) for all
    /// groups in order, which gives what is right.
    template <class Work>
    void for_groups(Work work) const {
        const std::size_t blocks = grid_.blocks();
        std::vector<std::uint64_t> before(GroupSums::kGroups * blocks);
        for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
            std::vector<std::uint64_t> others(blocks);
            for (std::size_t group = 0; group < GroupSums::kGroups; ++group)
                for (std::size_t block = 0; block < blocks; ++block) {
                    std::uint64_t& paths = before[group * blocks + block];
                    const std::uint64_t known = known_of_group(group, channel, block);
                    const std::uint64_t guess =
                        known + of_group(group, channel, block, paths, others[block]);
                    const std::size_t out = (channel * GroupSums::kGroups + group) * blocks + block;
                    const std::size_t in = (group * blocks + block) * shape_.channels + channel;
                    paths = work(out, in, guess) - known;
                    others[block] += paths;
                }
        }
    }

    /// Most units that each group can have had from what its blocks hold.
    std::vector<std::uint64_t> most_units_of_groups() const {
        std::vector<std::uint64_t> most(GroupSums::kGroups);
        const std::vector<std::uint64_t>& energy = layer_.spread.groups.energy;
        for (std::size_t group = 0; group < most.size(); ++group) {
            std::optional<std::uint64_t> least;
            for (std::size_t k = 0; k < known_of_block_.size(); ++k) {
                if (known_of_block_[k] == 0) continue;
                const std::size_t channel = k / grid_.blocks(), block = k % grid_.blocks();
                const std::uint64_t units =
                    energy[(group * grid_.blocks() + block) * shape_.channels + channel] /
                    known_of_block_[k];
                least = std::min(units, least.value_or(units));
            }
            most[group] = least.value_or(0);
        }
        return most;
    }

  private:
    /// By channel and block; empty if there are none.
    std::vector<std::uint64_t> by_block(std::span<const std::uint64_t> cells) const {
        if (cells.empty()) return {};
        std::vector<std::uint64_t> sums(shape_.channels * grid_.blocks());
        std::vector<std::size_t> block(shape_.cells);
        for (std::size_t cell = 0; cell < block.size(); ++cell) block[cell] = grid_.block_of(cell);
        for (std::size_t c = 0; c < shape_.channels; ++c)
            for (std::size_t cell = 0; cell < block.size(); ++cell)
                sums[c * grid_.blocks() + block[cell]] += cells[c * block.size() + cell];
        return sums;
    }

    const Layer& layer_;
    const SparedLayer& spared_;
    const SumShape& shape_;
    CoarseGrid grid_;
    std::uint64_t batches_;
    std::vector<std::uint64_t> paths_, of_block_, known_of_block_;
};

/// Splits the energy of the first order in that of known facets and that of paths.
void take_known(const Layer& layer, SparedLayer& spared) {
    const std::vector<std::uint64_t>& exact = layer.spread.exact;
    for (const std::uint64_t e : exact) spared.known_unit = std::gcd(spared.known_unit, e);
    if (spared.known_unit == 0) return;
    spared.known.reserve(exact.size());
    spared.energy = layer.energy;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        spared.known.push_back(exact[k] / spared.known_unit);
        spared.energy[k] -= exact[k];
    }
}

/// Most that the square of one unit can be from what the cells hold.
Wide most_squares(const Layer& layer, const SparedLayer& spared) {
    std::optional<Wide> least;
    for (std::size_t k = 0; k < spared.known.size(); ++k) {
        if (spared.known[k] == 0) continue;
        const Wide square = layer.spread.squares[k] / (Wide{spared.known[k]} * spared.known[k]);
        least = std::min(square, least.value_or(square));
    }
    return least.value_or(0);
}

bool spares_sums(const Layer& layer) {
    return !layer.spread.squares.empty() && !layer.spread.reached.empty();
}

}  // namespace

SparedLayer spare(const Layer& layer, const SumShape& shape) {
    SparedLayer spared;
    take_known(layer, spared);
    spared.known_of_group.resize(GroupSums::kGroups);
    if (!spares_sums(layer)) return spared;
    spared.known_squares = most_squares(layer, spared);
    const Guess guess(layer, spared.energy.empty() ? layer.energy : spared.energy, spared, shape);
    spared.known_of_group = guess.most_units_of_groups();

    const std::size_t size = layer.spread.squares.size();
    spared.squares.resize(2 * size);
    guess.for_squares([&](std::size_t k, Wide guessed) {
        const Wide right = layer.spread.squares[k], left = folded(right - guessed);
        spared.squares[k] = static_cast<std::uint64_t>(left);
        spared.squares[size + k] = static_cast<std::uint64_t>(left >> 64);
        return right;
    });
    spared.groups.resize(layer.spread.groups.energy.size());
    guess.for_groups([&](std::size_t out, std::size_t in, std::uint64_t guessed) {
        const std::uint64_t right = layer.spread.groups.energy[in];
        spared.groups[out] = folded(right - guessed);
        return right;
    });
    const std::vector<float> errors = errors_of(layer, shape);
    spared.errors_follow =
        errors.size() == layer.stderr_energy.size() &&
        std::memcmp(errors.data(), layer.stderr_energy.data(), errors.size() * sizeof(float)) == 0;
    return spared;
}

void restore(Layer& layer, const SparedLayer& spared, const SumShape& shape) {
    if (!spared.squares.empty()) {
        const Guess guess(layer, layer.energy, spared, shape);
        const std::size_t size = spared.squares.size() / 2;
        layer.spread.squares.resize(size);
        guess.for_squares([&](std::size_t k, Wide guessed) {
            return layer.spread.squares[k] =
                       guessed +
                       unfolded((Wide{spared.squares[size + k]} << 64) | spared.squares[k]);
        });
        if (!spared.groups.empty()) {
            layer.spread.groups.energy.resize(spared.groups.size());
            guess.for_groups([&](std::size_t out, std::size_t in, std::uint64_t guessed) {
                return layer.spread.groups.energy[in] = guessed + unfolded(spared.groups[out]);
            });
        }
    }
    layer.spread.exact.resize(spared.known.size());
    for (std::size_t k = 0; k < spared.known.size(); ++k) {
        layer.spread.exact[k] = spared.known[k] * spared.known_unit;
        layer.energy[k] += layer.spread.exact[k];
    }
    if (spared.errors_follow) layer.stderr_energy = errors_of(layer, shape);
}

}  // namespace asperity::io
