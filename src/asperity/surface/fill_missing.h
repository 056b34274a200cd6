// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/topography.h>

#include <cstddef>

namespace asperity {

/// Marks as missing each point that differs from the median of the measured points among the 5 x 5
/// around it by more than `sigma` deviations, and returns how many. A deviation is 1.4826 times the
/// median of these differences over the surface; their RMS where more than half of them are zero.
std::size_t mark_outliers(Topography& topography, double sigma, const Run& run);

/// Gives each missing point the height of the nearest measured one, distances in units of length;
/// of several the one further left, then further up. Needs one measured point. The points stay
/// marked. Cost: linear.
void fill_nearest(Topography& topography);

/// Spans a film over each hole: heights solve Laplace's equation there, with no flow through the
/// edge of the surface, after the least-squares plane is taken off; it is put on again, so a tilt
/// goes on through a hole at the edge. Needs one measured point. The points stay marked. Cost: a
/// sparse system of as many unknowns as are missing.
void fill_smooth(Topography& topography, const Run& run);

}  // namespace asperity
