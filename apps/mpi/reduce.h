// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/layer_sums.h>

#include <mpi.h>

#include <cstddef>
#include <optional>

namespace asperity::mpi {

/// Whether it holds on any of the ranks. A collective call.
bool any(bool mine, MPI_Comm ranks = MPI_COMM_WORLD);

/// MPI counts in int: longer arrays are reduced in pieces of so many elements.
inline constexpr std::size_t kPiece = std::size_t{1} << 27;

/// The sum over all ranks, on each of them, of what they did of a layer; nothing where none of them
/// did anything. `mine` is settled, or nothing, and has this shape. Integers, so the sum does not
/// depend on how the ranks are ordered. A collective call. Throws Error(Usage) for a batch that two
/// of them did.
std::optional<LayerSums> sum_over_ranks(const std::optional<LayerSums>& mine, const SumShape& shape,
                                        std::uint64_t largest_batch, MPI_Comm ranks,
                                        std::size_t piece = kPiece);

}  // namespace asperity::mpi
