// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/power_spectrum.h>

#include <cstdint>

namespace asperity {

/// A periodic Gaussian random field of zero mean with the given power spectrum, scaled so that its
/// expected RMS facet gradient is `rms_gradient`.
///
/// Made in the frequency domain: each coefficient is a complex normal number that belongs to (seed,
/// kx, ky), times the root of the density. In place: the heights are the only large array. Writes
/// heights of nx x ny samples; advances `run` by transform_steps(); throws Error(Stopped).
void fill_gaussian(Heightfield& surface, const PowerSpectrumSettings& spectrum, double rms_gradient,
                   std::uint64_t seed, Run& run);

/// Multiplies the heights so that the RMS gradient over the facets is `rms_gradient`; a flat
/// surface stays flat. Throws Error(Stopped).
void rescale_to_gradient(Heightfield& surface, double rms_gradient, const Run& run);

}  // namespace asperity
