// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/batch_sums.h>

#include <cstdint>
#include <span>
#include <vector>

namespace asperity::io {

/// Energies that paths brought to cells, told from each other: cells side by side get light from
/// facets of nearly the same slope, which reflect a channel nearly as much more than another one.
/// Before the first channel stand the numbers of paths. docs/formats.md, "What is left out".
struct EnergyRests {
    /// [order * cells + cell]. Guessed by whoever writes: energies come back to the bit from any.
    std::vector<std::uint32_t> paths;
    /// Of a path where nothing tells better, and the power of 2 that divides all energies:
    /// [order * channels + channel].
    std::vector<std::uint64_t> of_path;
    std::vector<std::uint8_t> zeros;
    std::vector<std::uint64_t> rests;  ///< like Layer::energy
};

EnergyRests energy_rests(std::span<const std::uint64_t> energy, const SumShape& shape);
/// The way back, in the memory of the rests. Arrays of `rests` have the sizes of the shape, zeros
/// are less than 64.
std::vector<std::uint64_t> take_energy(EnergyRests& rests, const SumShape& shape);

}  // namespace asperity::io
