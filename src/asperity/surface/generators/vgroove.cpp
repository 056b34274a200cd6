// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

namespace asperity::generators {

SurfaceKind vgroove() {
    return {
        .name = "vgroove",
        .label = "V-grooves",
        .doc = "symmetric grooves: tan(tilt) times the distance to the nearest valley",
        .params = {"tilt", "period", "along-y"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                const double slope = slope_of_tilt(s);
                fill_one_way(
                    surface, s,
                    [&](int i, double step) { return slope * step * to_valley(i, s.period); }, run);
            },
        .check = check_even_period,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("vgroove, {} degrees, period {}{}", s.tilt_deg, s.period,
                                   s.along_y ? ", along y" : "");
            },
    };
}

}  // namespace asperity::generators
