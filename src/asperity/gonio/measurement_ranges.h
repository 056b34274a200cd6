// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <string>

namespace asperity {

/// Which figure of the measurement no run can have, in one line; empty when there is none. Its
/// arrays must have the right sizes. Looked for are
///     errors that are negative, NaN, or infinite with more than one batch,
///     counts that are negative or do not fit each other: batches, rays, reflections, stuck ones,
///     layers of light that the experiment does not have, or not in this order,
///     sides and spacings of the surface that are no sizes.
/// Cost: reads all errors once.
std::string out_of_range(const Measurement& measurement);

}  // namespace asperity
