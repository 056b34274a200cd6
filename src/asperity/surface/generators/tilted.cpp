// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

namespace asperity::generators {

SurfaceKind tilted() {
    return {
        .name = "tilted",
        .label = "Tilted facet",
        .doc =
            "one facet over the whole tile, its return in the last cell; a finite patch is one "
            "plane",
        .params = {"tilt", "along-y"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                const double slope = slope_of_tilt(s);
                fill_one_way(
                    surface, s, [=](int i, double step) { return slope * step * i; }, run);
            },

        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("tilted, {} degrees{}", s.tilt_deg,
                                   s.along_y ? ", along y" : "");
            },
    };
}

}  // namespace asperity::generators
