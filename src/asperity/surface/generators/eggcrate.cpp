// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::generators {

SurfaceKind eggcrate() {
    return {
        .name = "eggcrate",
        .label = "Egg crate",
        .doc = "amplitude (sin(2 pi x / period) + sin(2 pi y / period)) / 2",
        .params = {"period", "amplitude"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                fill_both_ways(
                    surface,
                    [&](int i, double) {
                        return s.amplitude * std::sin(2 * kPi * (i % s.period) / s.period) / 2;
                    },
                    run);
            },
        .check = check_wave,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("eggcrate, amplitude {}, period {}", s.amplitude, s.period);
            },
    };
}

}  // namespace asperity::generators
