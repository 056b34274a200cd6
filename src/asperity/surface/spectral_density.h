// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>

#include <vector>

namespace asperity {

/// The power spectral density of the heights about their mean: |h~(f)|^2 / area with h~ the Fourier
/// integral over the surface and f in waves per unit of length. The integral over all f is Sq^2. A
/// surface with edges is seen through a Hann window, made up for in the mean.
struct SpectralDensity {
    std::vector<double> frequency;  ///< middles of rings [1 / unit]
    std::vector<double> radial;     ///< mean over each ring [unit^4]
    /// Direction of the lay [degrees, -90 < . <= 90], see ArealParameters::std_deg.
    double direction_deg = 0;
    bool flat = true;  ///< nothing to see
};

/// Same value for any number of threads. Throws Error(Stopped).
SpectralDensity spectral_density(const Heightfield& surface, Run& run);

}  // namespace asperity
