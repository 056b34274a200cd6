// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/spared_layer.h>
#include <asperity/formats/results/tensor_file.h>

#include <span>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Of Layer::energy where it is left out: stands where that would.
inline constexpr std::string_view kEnergyRest = "energy_rest";

/// The fields of a result file that hold `layers`, all of this shape; that of the energy first. The
/// layers must outlive them.
std::vector<TensorBlock> spared_blocks(std::span<const SparedLayer> layers, const SumShape& shape);

/// The way back, of `count` layers. Files of format 3 told fewer things so: `energy_of_paths` is no
/// part of what is read here. `groups`: what groups of batches brought is read, too.
std::vector<SparedLayer> read_spared_layers(const TensorFile& file, std::size_t count,
                                            const SumShape& shape, bool groups);

}  // namespace asperity::io
