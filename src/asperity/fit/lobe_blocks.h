// SPDX-License-Identifier: Apache-2.0
#pragma once

// How a layer is cut into blocks; inside this folder only.

#include <asperity/fit/fit_data.h>

#include <span>
#include <vector>

namespace asperity::detail {

/// One layer: [channel * cells + cell]; `variance` may be empty.
struct LayerEnergies {
    std::vector<double> energy, variance;
};

/// Appends the blocks of a layer to `data`, with their nodes, energies and spreads; cells of rows
/// from `rows` on are left out.
void append_blocks(FitData& data, const FitLayer& layer, const LayerEnergies& values, int rows);

}  // namespace asperity::detail
