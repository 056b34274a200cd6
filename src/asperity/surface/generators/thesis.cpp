// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/thesis_noise.h>

#include <fmt/format.h>

namespace asperity::generators {

SurfaceKind thesis() {
    return {
        .name = "thesis",
        .label = "Thesis noise",
        .doc = "independent heights, uniform in 0 to 10 roughness cells (thesis 2.2.2)",
        .params = {"roughness", "surface-seed"},
        .fill = [](Heightfield& surface, const SurfaceSettings& s,
                   Run& run) { fill_thesis_noise(surface, s.roughness, s.seed, run); },
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("thesis noise, roughness {}, seed {}", s.roughness, s.seed);
            },
    };
}

}  // namespace asperity::generators
