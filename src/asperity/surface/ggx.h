// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/slope_distribution.h>

namespace asperity {

/// Rounds of impose_slope_law that make_surface asks for: the distance to GGX is then below 0.005.
inline constexpr int kGgxRounds = 8;

/// Changes the heights so that the facet slopes follow `law`, by alternating projection.
///
/// Each round
/// 1. ranks all facets in stretched slope space, where the law is the same in every direction: by
///    azimuth, and within 16 sectors of azimuth by length;
/// 2. wants every facet to have the azimuth and the length of its ranks under the law (uniform, and
///    GGX: r = sqrt(u / (1 - u))), cut at the slope law.max_slope;
/// 3. takes the heights whose facets come nearest to that in the sense of least squares: an edge
///    gets the mean of what its two facets want, and the divergence of that is integrated by the
///    Poisson equation of the periodic grid, in the frequency domain.
/// Without sectors the widths along x and y drift apart by a tenth when alpha_x and alpha_y differ.
/// The surface that goes in decides how far slopes are correlated. Treated as periodic throughout.
///
/// Ranks come from exact counts (LengthHistogram), so the result has the same bits for any number
/// of threads. Memory: 8 bytes a sample in all, 4 of them the heights, plus 11 MB. Advances `run`
/// by rounds * impose_steps(); throws Error(Stopped).
void impose_slope_law(Heightfield& surface, const SlopeLaw& law, int rounds, Run& run);

/// Steps of progress of one round.
std::uint64_t impose_steps(int nx, int ny);

}  // namespace asperity
