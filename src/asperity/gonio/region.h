// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <span>
#include <vector>

namespace asperity {

/// Outgoing directions between two polar angles and two azimuths [rad], azimuths growing from the
/// first to the second, over 2 pi if need be: 350 to 370 degrees.
struct Region {
    double theta_from = 0, theta_to = 0.5 * kPi, phi_from = 0, phi_to = 2 * kPi;
};

/// Cells of a detector whose centre is in the region, in ascending order. Throws Error(Usage,
/// "region") where angles are no region of the hemisphere.
std::vector<int> cells_in(const Detector& detector, const Region& region);

/// What leaves into several cells, as a fraction of the launched energy.
struct EnergyOfCells {
    double energy = 0;
    /// Standard error; NaN where the result does not hold what it comes from (those of older
    /// versions do not). 0: known exactly.
    double error = 0;
    /// Few rays, less than 10: the error is a rough one.
    bool few_rays = false;
};

/// Energy over all orders of a channel in these cells, each named once, with its standard error.
///
/// Cells beside each other err together, so their errors cannot be added, nor their squares. This
/// one comes from sums over 32 x 64 blocks of cells by 16 groups of batches, which results keep: on
/// detectors of up to 64 columns, and for whole blocks of larger ones, it is that of the batches
/// themselves. Of a block that is taken in part, the part follows the whole, and is wrong by its
/// own cells' errors besides, taken as alike as cells within blocks are in the mean over the layer.
/// Student's t with 15 degrees of freedom makes intervals of it (batches - 1, if there are fewer
/// than 16). One cell alone has its own error. Cost: some operations a block, group and cell.
/// Source: docs/theory.md, "Sums of cells".
EnergyOfCells energy_of_cells(const Measurement& measurement, const Layer& layer, int channel,
                              std::span<const int> cells);

}  // namespace asperity
