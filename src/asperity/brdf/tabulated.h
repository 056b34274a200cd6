// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/brdf/brdf.h>
#include <asperity/gonio/measurement.h>

#include <memory>

namespace asperity {

/// The BRDF of a Measurement: evaluated between its layers and sampled with a matching density.
/// Throws Error(InvalidInput) when the measurement has no layers or its layers do not form a grid
/// of theta_i x phi_i. Keeps its own copy of the tables.
std::unique_ptr<Brdf> make_tabulated_brdf(const Measurement& measurement);

}  // namespace asperity
