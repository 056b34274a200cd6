// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/illumination.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/measurement.h>

#include <vector>

namespace asperity {

/// The layer that sums of at least one batch make, with their standard errors: infinite ones of a
/// single batch.
Layer layer_of(const Incidence& light, const LayerSums& sums);

/// The sums that a layer of a result was made of, to which more may be added; the way back from
/// layer_of. Throws Error(InvalidInput) if it does not say what its errors come from: results of
/// format 1 do not.
LayerSums sums_of(const Layer& layer, const SumShape& shape);

/// Layer::stderr_energy of these settled sums. Result files leave it out and make it again
/// (formats/results/spared_layer.h): where it is to give other bits, those of earlier results must
/// still be had.
std::vector<float> errors_of(const LayerSums& sums);
/// Those of sums_of(layer, shape), without making all of these. Likewise throws.
std::vector<float> errors_of(const Layer& layer, const SumShape& shape);

}  // namespace asperity
