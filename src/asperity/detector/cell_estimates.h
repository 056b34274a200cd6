// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/layer_sums.h>

#include <vector>

namespace asperity {

/// Energies of all places over all orders with their standard errors, [place * values + value], of
/// settled sums.
///
/// The error is that of the mean over batches, and of a ray more or less where few have come: a
/// cell that was reached a handful of times is skewed, and its batches tell too little. The size of
/// that ray is the mean of those that came to the cell and, where none did, of those around it; it
/// counts in full where rays are many, and the less the fewer come to the 3 x 3 cells around, so
/// that what is known exactly keeps its small error. Cells without energy have no error.
/// Elements of polarised light above 0 have the batches' error alone.
/// Cost: some operations a place and value. Source: docs/theory.md, "Estimate errors".
std::vector<LayerSums::Estimate> cell_estimates(const LayerSums& sums);

}  // namespace asperity
