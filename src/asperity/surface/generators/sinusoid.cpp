// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::generators {

SurfaceKind sinusoid() {
    return {
        .name = "sinusoid",
        .label = "Sinusoid",
        .doc = "amplitude sin(2 pi x / period)",
        .params = {"period", "amplitude", "along-y"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                fill_one_way(
                    surface, s,
                    [&](int i, double) {
                        return s.amplitude * std::sin(2 * kPi * (i % s.period) / s.period);
                    },
                    run);
            },
        .check = check_wave,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("sinusoid, amplitude {}, period {}{}", s.amplitude, s.period,
                                   s.along_y ? ", along y" : "");
            },
    };
}

}  // namespace asperity::generators
