// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity {

/// The areal linear Gaussian filter of ISO 16610-61: the mean of the heights around each point with
/// weights exp(-pi (r / (alpha L))^2), alpha = sqrt(ln 2 / pi), over all whose distance along x and
/// along y is at most L. A wave of wavelength L keeps half of its height, one of wavelength W
/// exp(-pi (alpha L / W)^2) = 2^-(L / W)^2 of it.
///
/// `cutoff` L is in the unit of dx and dy. Periodic surfaces go on beyond their edges; at the edges
/// of others the weights are those of the points there are, scaled to sum 1. heights[j * nx + i].
/// Cost: two Fourier transforms a line. Same bits for any number of threads; throws Error(Stopped).
void gaussian_low_pass(std::vector<double>& heights, int nx, int ny, double dx, double dy,
                       double cutoff, Boundary boundary, const Run& run);

}  // namespace asperity
