// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::generators {

SurfaceKind pyramids() {
    return {
        .name = "pyramids",
        .label = "Pyramids",
        .doc = "facets of one tilt towards the four corners, all creases on grid lines",
        .params = {"tilt", "period"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                const double slope = slope_of_tilt(s);
                fill_both_ways(
                    surface,
                    [&](int i, double step) {
                        return slope * step * to_valley(i, s.period) / std::sqrt(2.0);
                    },
                    run);
            },
        .check = check_even_period,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("pyramids, {} degrees, period {}", s.tilt_deg, s.period);
            },
    };
}

}  // namespace asperity::generators
