// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/heightfield.h>

#include <span>

namespace asperity {

/// Throws Error(InvalidInput, name of the surface) for heights from `lowest` to `highest` that
/// light cannot be followed over, whatever the time: that range over more than 2^24 cells, where
/// single precision cannot tell one cell from the next, or that light at one of the polar angles
/// `theta` [rad], below pi / 2, crosses more than 2^24 cells to sink through. The message asks
/// about units.
void check_scale(const Heightfield& surface, double lowest, double highest,
                 std::span<const double> theta);

}  // namespace asperity
