// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/surface/topography.h>

namespace asperity {

/// Columns first_x .. first_x + nx - 1 and rows first_y .. first_y + ny - 1 alone. A surface of
/// which a part is taken does not repeat. Needs a part that lies inside.
void crop(Topography& topography, int first_x, int first_y, int nx, int ny);

/// The same surface in nx x ny samples, each the mean over its cell of the straight lines between
/// the samples there were; beyond the last ones of a surface with edges, of the line through the
/// last two. A plane stays a plane.
void resample(Topography& topography, int nx, int ny);

}  // namespace asperity
