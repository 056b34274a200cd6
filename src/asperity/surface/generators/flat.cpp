// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

namespace asperity::generators {

SurfaceKind flat() {
    return {
        .name = "flat",
        .label = "Flat",
        .doc = "one level plane",
        .fill = [](Heightfield& surface, const SurfaceSettings&,
                   Run& run) { fill_both_ways(surface, {}, run); },
        .isotropic = [](const SurfaceSettings&) { return true; },
        .describe = [](const SurfaceSettings&) { return std::string("flat"); },
    };
}

}  // namespace asperity::generators
