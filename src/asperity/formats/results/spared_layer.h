// SPDX-License-Identifier: Apache-2.0
// What a packed result file leaves out of a layer: what follows from the rest to the bit, or nearly
// so. docs/formats.md, "What is left out", says it in formulas.
#pragma once

#include <asperity/formats/results/energy_rests.h>
#include <asperity/gonio/measurement.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity::io {

/// A layer without what follows from the rest. All differences are taken modulo 2^64 or 2^128: any
/// layer comes back to the bit, and a likely one gets small. What is left of numbers that are next
/// to guesses are whole numbers next to 0, stored as 0, -1, 1, -2 ...
struct SparedLayer {
    /// Sums that are told as rests.
    enum Kind : std::size_t { kSquares, kGroups, kHalves, kKinds };

    /// Energy that known facets brought is a multiple of this, as each ray brought as much; 0 where
    /// they brought none.
    std::uint64_t known_unit = 0;
    std::vector<std::uint64_t> known;   ///< in units, [channel * cells + cell]; empty without
    EnergyRests energy;                 ///< Layer::energy without it; empty if it is not left out
    LayerSums::Wide known_squares = 0;  ///< of a cell with one unit: sum over batches of its square
    std::vector<std::uint64_t> known_of_group;  ///< units that a group of batches brought
    /// The power of 2 that divides what is told here without known facets:
    /// [Kind * channels + channel].
    std::vector<std::uint8_t> zeros;
    /// Sums over batches of the square of the number of paths into a cell, [cell]; like
    /// EnergyRests::paths a guess of the writer. Empty: not told.
    std::vector<std::uint64_t> path_squares;
    /// Of LayerSpread::squares: [word * channels * cells + channel * cells + cell], the low words
    /// first.
    std::vector<std::uint64_t> squares;
    std::vector<std::uint64_t> path_halves;  ///< likewise of LayerSpread::halves
    std::vector<std::uint64_t> halves;
    std::vector<std::uint64_t> path_groups;  ///< paths of a group, [group * blocks + block]
    /// Of GroupSums::energy: [(channel * groups + group) * blocks + block].
    std::vector<std::uint64_t> groups;
    bool errors_follow = false;  ///< stderr_energy is left out: the sums tell it
};

/// Of a layer with squares and groups.
SparedLayer spare(const Layer& layer, const SumShape& shape);

/// The way back: `layer` has all that `spared` does not, which is left in no certain state. Of
/// files of format 3, where `spared` tells no numbers of paths, the layer's energy is that of
/// paths. Arrays of `spared` have the sizes of the shape, or are empty; powers of 2 are less than
/// the bits of the numbers.
void restore(Layer& layer, SparedLayer& spared, const SumShape& shape);

}  // namespace asperity::io
