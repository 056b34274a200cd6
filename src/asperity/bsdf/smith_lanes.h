// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/smith.h>

#include <span>

namespace asperity {

/// Of the facets that mirror wi to each wo, both above the horizon: their normal_density(), and the
/// cosine wi . wm = |wi + wo| / 2, at most 1. In the lanes of a vector; other digits than those of
/// SmithSurface from the 15th on, the same on every processor.
void mirroring_facets(const SmithSurface& surface, Vec3 wi, std::span<const Vec3> wo,
                      double* density, double* cosine);

}  // namespace asperity
