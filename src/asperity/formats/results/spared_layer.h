// SPDX-License-Identifier: Apache-2.0
// What a packed result file leaves out of a layer: what follows from the rest to the bit, or nearly
// so. docs/formats.md, "What is left out", says it in formulas.
#pragma once

#include <asperity/gonio/measurement.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity::io {

/// A layer without what follows from the rest. All differences are taken modulo 2^64 or 2^128: any
/// layer comes back to the bit, and a likely one gets small.
struct SparedLayer {
    /// Energy that known facets brought is a multiple of this, as each ray brought as much; 0 where
    /// they brought none.
    std::uint64_t known_unit = 0;
    std::vector<std::uint64_t> known;   ///< in units, [channel * cells + cell]; empty without
    std::vector<std::uint64_t> energy;  ///< Layer::energy without it, in the same order; empty
                                        ///< where that is the same
    LayerSums::Wide known_squares = 0;  ///< of a cell with one unit: sum over batches of its square
    std::vector<std::uint64_t> known_of_group;  ///< units that a group of batches brought
    /// What is left of LayerSpread::squares, [word * channels * cells + channel * cells + cell],
    /// the low words first. Of whole numbers that are next to 0: 0, -1, 1, -2 ...
    std::vector<std::uint64_t> squares;
    /// What is left of GroupSums::energy, likewise: [(channel * groups + group) * blocks + block].
    std::vector<std::uint64_t> groups;
    bool errors_follow = false;  ///< stderr_energy is left out: the sums tell it
};

/// Of a layer with squares and groups or without: what it does not have stays empty.
SparedLayer spare(const Layer& layer, const SumShape& shape);

/// The way back: `layer` has all that `spared` does not, its `energy` being that of paths. Arrays
/// of `spared` have the sizes of the shape, or are empty.
void restore(Layer& layer, const SparedLayer& spared, const SumShape& shape);

}  // namespace asperity::io
