// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/slope_distribution.h>

#include <optional>

namespace asperity {

/// A law of slopes fitted to those of a surface.
struct SlopeFit {
    double alpha_x = 0, alpha_y = 0;
    /// The Kolmogorov-Smirnov distance that is left: 0 where the law holds, about 0.1 between
    /// Beckmann and GGX. What chance leaves grows as the patches of the surface become fewer.
    double misfit = 0;
};

/// alpha_y / alpha_x is that of the medians of the slopes' sizes along y and x; alpha_x is what
/// makes the misfit least. Slopes count about zero, every facet alike. Nothing where half of the
/// slopes along x or y are zero. Memory 10 MB; same value for any number of threads.
std::optional<SlopeFit> fit_slopes(const Heightfield& surface, SlopeFamily family, int threads);

}  // namespace asperity
