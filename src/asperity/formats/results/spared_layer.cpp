// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/spared_layer.h>

#include <asperity/formats/results/sum_guesses.h>
#include <asperity/gonio/layer_of_sums.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>

namespace asperity::io {

namespace {

using Words = std::vector<std::uint64_t>;

/// 128 bits in two words, of which all the low ones come first.
void put_wide(Words& words, std::size_t k, Wide x) {
    words[k] = static_cast<std::uint64_t>(x);
    words[words.size() / 2 + k] = static_cast<std::uint64_t>(x >> 64);
}
Wide get_wide(const Words& words, std::size_t k) {
    return (Wide{words[words.size() / 2 + k]} << 64) | words[k];
}

/// Splits the energy of the first order in that of known facets and that of paths, which it gives;
/// empty if they brought all.
Words take_known(const Layer& layer, SparedLayer& spared) {
    const Words& exact = layer.spread.exact;
    for (const std::uint64_t e : exact) spared.known_unit = std::gcd(spared.known_unit, e);
    if (spared.known_unit == 0) return {};
    Words paths = layer.energy;
    spared.known.reserve(exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) {
        spared.known.push_back(exact[k] / spared.known_unit);
        paths[k] -= exact[k];
    }
    return paths;
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

/// Most units that each group can have had from what its blocks hold.
Words most_units_of_groups(const Layer& layer, const SumGuesses& guesses, std::size_t channels) {
    Words most(GroupSums::kGroups);
    const Words &known = guesses.known_of_blocks(), &energy = layer.spread.groups.energy;
    const std::size_t blocks = guesses.grid().blocks();
    for (std::size_t group = 0; group < most.size(); ++group) {
        std::optional<std::uint64_t> least;
        for (std::size_t k = 0; k < known.size(); ++k) {
            if (known[k] == 0) continue;
            const std::size_t channel = k / blocks, block = k % blocks;
            const std::uint64_t units =
                energy[(group * blocks + block) * channels + channel] / known[k];
            least = std::min(units, least.value_or(units));
        }
        most[group] = least.value_or(0);
    }
    return most;
}

/// The number that fits sums of a first channel best, of which its energy is `energy` and the
/// number of paths `count`, to this power.
std::uint64_t fitting(double sum, std::uint64_t energy, std::uint64_t count, int power) {
    if (energy == 0) return 0;
    const double per_unit = static_cast<double>(count) / static_cast<double>(energy);
    return whole64(sum * (power == 2 ? per_unit * per_unit : per_unit) + 0.5);
}

/// Leaves out of one layer, step by step.
class Sparing {
  public:
    Sparing(const Layer& layer, const SumShape& shape, SparedLayer& spared,
            const SumGuesses& guesses)
        : layer_(layer), shape_(shape), spared_(spared), guesses_(guesses) {
        spared_.zeros.resize(SparedLayer::kKinds * shape.channels);
    }

    void squares() {
        const auto& all = layer_.spread.squares;
        set_zeros(SparedLayer::kSquares,
                  [&](std::size_t k) { return all[k] - guesses_.known_squares(k); });
        const Words counts = path_numbers(spared_.path_squares, [&](std::size_t k) {
            const std::uint64_t guess = guesses_.path_squares(k);
            if (layer_.spread.reached[k] < 2) return std::pair(guess, guess);
            return std::pair(guess, fitting_square(k, all[k] - guesses_.known_squares(k)));
        });
        spared_.squares.resize(2 * all.size());
        guesses_.for_squares(counts, [&](std::size_t k, Wide known, Wide guess) {
            const Wide right = all[k] - known;
            put_wide(spared_.squares, k, rest_of(right, guess, zeros(SparedLayer::kSquares, k)));
            return right;
        });
    }

    void halves() {
        const auto& all = layer_.spread.halves.cells;
        if (all.empty()) return;
        set_zeros(SparedLayer::kHalves, [&](std::size_t k) { return all[k]; });
        const Words counts = path_numbers(spared_.path_halves, [&](std::size_t k) {
            return std::pair(std::uint64_t{0}, fitting_square(k, all[k]));
        });
        spared_.halves.resize(2 * all.size());
        guesses_.for_halves(counts, [&](std::size_t k, Wide guess) {
            put_wide(spared_.halves, k, rest_of(all[k], guess, zeros(SparedLayer::kHalves, k)));
            return all[k];
        });
    }

    void groups() {
        const Words& all = layer_.spread.groups.energy;
        const std::size_t blocks = guesses_.grid().blocks(), size = GroupSums::kGroups * blocks;
        const std::size_t channels = shape_.channels;
        const auto paths = [&](std::size_t group, std::size_t channel, std::size_t block) {
            return all[(group * blocks + block) * channels + channel] -
                   guesses_.known_of_group(group, channel, block);
        };
        for (std::size_t channel = 0; channel < channels; ++channel) {
            std::uint64_t bits = 0;
            for (std::size_t k = 0; k < size; ++k) bits |= paths(k / blocks, channel, k % blocks);
            spared_.zeros[SparedLayer::kGroups * channels + channel] =
                static_cast<std::uint8_t>(zeros_of(bits));
        }
        Words counts(size);
        spared_.path_groups.resize(size);
        for (std::size_t k = 0; k < size; ++k) {
            const std::size_t group = k / blocks, block = k % blocks;
            const std::uint64_t guess = guesses_.path_group(group, block);
            // The last group is told by the others
            counts[k] = group + 1 == GroupSums::kGroups
                            ? guess
                            : fitting(static_cast<double>(as_signed(paths(group, 0, block))),
                                      guesses_.energy_of_blocks()[block],
                                      guesses_.counts_of_blocks()[block], 1);
            spared_.path_groups[k] = folded(counts[k] - guess);
        }
        spared_.groups.resize(all.size());
        guesses_.for_groups(
            counts, [&](std::size_t out, std::size_t in, std::uint64_t known, std::uint64_t guess) {
                const std::uint64_t right = all[in] - known;
                spared_.groups[out] = rest_of(
                    right, guess, spared_.zeros[SparedLayer::kGroups * channels + out / size]);
                return right;
            });
    }

  private:
    unsigned zeros(SparedLayer::Kind kind, std::size_t k) const {
        return spared_.zeros[kind * shape_.channels + k / shape_.cells];
    }
    /// part(k) of all cells.
    template <class Part>
    void set_zeros(SparedLayer::Kind kind, Part part) {
        for (std::size_t c = 0; c < shape_.channels; ++c) {
            Wide bits = 0;
            for (std::size_t k = c * shape_.cells; k < (c + 1) * shape_.cells; ++k) bits |= part(k);
            spared_.zeros[kind * shape_.channels + c] = static_cast<std::uint8_t>(zeros_of(bits));
        }
    }
    std::uint64_t fitting_square(std::size_t cell, Wide sum) const {
        return fitting(static_cast<double>(as_signed(sum)), guesses_.energy()[cell],
                       guesses_.counts()[cell], 2);
    }
    /// Numbers by cell of which numbers(cell) gives the guess and the right one, and their rests.
    template <class Numbers>
    Words path_numbers(Words& rests, Numbers numbers) const {
        Words right(shape_.cells);
        rests.resize(shape_.cells);
        for (std::size_t k = 0; k < shape_.cells; ++k) {
            const auto [guess, number] = numbers(k);
            right[k] = number;
            rests[k] = folded(number - guess);
        }
        return right;
    }

    const Layer& layer_;
    const SumShape& shape_;
    SparedLayer& spared_;
    const SumGuesses& guesses_;
};

/// Puts back what Sparing left out.
class Restoring {
  public:
    Restoring(Layer& layer, const SparedLayer& spared, const SumShape& shape)
        : layer_(layer),
          spared_(spared),
          shape_(shape),
          guesses_(layer, layer.energy, spared, shape) {}

    void squares() {
        auto& all = layer_.spread.squares;
        all.resize(spared_.squares.size() / 2);
        const Words counts = right_numbers(spared_.path_squares,
                                           [&](std::size_t k) { return guesses_.path_squares(k); });
        guesses_.for_squares(counts, [&](std::size_t k, Wide known, Wide guess) {
            const Wide right = from_rest(get_wide(spared_.squares, k), guess,
                                         zeros(SparedLayer::kSquares, k / shape_.cells));
            all[k] = right + known;
            return right;
        });
    }
    void halves() {
        if (spared_.halves.empty()) return;
        auto& all = layer_.spread.halves.cells;
        all.resize(spared_.halves.size() / 2);
        const Words counts =
            right_numbers(spared_.path_halves, [](std::size_t) { return std::uint64_t{0}; });
        guesses_.for_halves(counts, [&](std::size_t k, Wide guess) {
            return all[k] = from_rest(get_wide(spared_.halves, k), guess,
                                      zeros(SparedLayer::kHalves, k / shape_.cells));
        });
    }
    void groups() {
        if (spared_.groups.empty()) return;
        auto& all = layer_.spread.groups.energy;
        all.resize(spared_.groups.size());
        const std::size_t blocks = guesses_.grid().blocks(), size = GroupSums::kGroups * blocks;
        const Words counts = right_numbers(spared_.path_groups, [&](std::size_t k) {
            return guesses_.path_group(k / blocks, k % blocks);
        });
        guesses_.for_groups(
            counts, [&](std::size_t out, std::size_t in, std::uint64_t known, std::uint64_t guess) {
                const std::uint64_t right =
                    from_rest(spared_.groups[out], guess, zeros(SparedLayer::kGroups, out / size));
                all[in] = right + known;
                return right;
            });
    }

  private:
    unsigned zeros(SparedLayer::Kind kind, std::size_t channel) const {
        return spared_.zeros.empty() ? 0 : spared_.zeros[kind * shape_.channels + channel];
    }
    template <class Guess>
    static Words right_numbers(const Words& rests, Guess guess) {
        Words right(rests.size());
        for (std::size_t k = 0; k < rests.size(); ++k) right[k] = guess(k) + unfolded(rests[k]);
        return right;
    }

    Layer& layer_;
    const SparedLayer& spared_;
    const SumShape& shape_;
    SumGuesses guesses_;
};

}  // namespace

SparedLayer spare(const Layer& layer, const SumShape& shape) {
    SparedLayer spared;
    const Words without_known = take_known(layer, spared);
    const Words& paths = without_known.empty() ? layer.energy : without_known;
    spared.energy = energy_rests(paths, shape);
    spared.known_squares = most_squares(layer, spared);
    spared.known_of_group.resize(GroupSums::kGroups);
    const SumGuesses guesses(layer, paths, spared, shape);
    spared.known_of_group = most_units_of_groups(layer, guesses, shape.channels);
    Sparing sparing(layer, shape, spared, guesses);
    sparing.squares();
    sparing.halves();
    sparing.groups();
    const std::vector<float> errors = errors_of(layer, shape);
    spared.errors_follow =
        errors.size() == layer.stderr_energy.size() &&
        std::memcmp(errors.data(), layer.stderr_energy.data(), errors.size() * sizeof(float)) == 0;
    return spared;
}

void restore(Layer& layer, SparedLayer& spared, const SumShape& shape) {
    if (!spared.energy.rests.empty()) layer.energy = take_energy(spared.energy, shape);
    Restoring restoring(layer, spared, shape);
    restoring.squares();
    restoring.halves();
    restoring.groups();
    layer.spread.exact.resize(spared.known.size());
    for (std::size_t k = 0; k < spared.known.size(); ++k) {
        layer.spread.exact[k] = spared.known[k] * spared.known_unit;
        layer.energy[k] += layer.spread.exact[k];
    }
    if (spared.errors_follow) layer.stderr_energy = errors_of(layer, shape);
}

}  // namespace asperity::io
