// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

namespace asperity::generators {

SurfaceKind sawtooth() {
    return {
        .name = "sawtooth",
        .label = "Sawtooth",
        .doc = "one long facet a period, its return in one cell",
        .params = {"tilt", "period", "along-y"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                const double slope = slope_of_tilt(s);
                fill_one_way(
                    surface, s, [&](int i, double step) { return slope * step * (i % s.period); },
                    run);
            },
        .check = check_period,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("sawtooth, {} degrees, period {}{}", s.tilt_deg, s.period,
                                   s.along_y ? ", along y" : "");
            },
    };
}

}  // namespace asperity::generators
