// SPDX-License-Identifier: Apache-2.0
// Rounded ridges with level land between them: worn grooves, lenticular sheets, printed lines.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/profile.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::generators {

namespace {

/// Cells of a period that stay level; the ridge has the others, an even number of at least four.
std::int64_t land_of(const SurfaceSettings& s) {
    return own<std::int64_t>(s, "land", 0);
}

void check_ridges(const SurfaceSettings& s) {
    check_period(s);
    const std::int64_t width = s.period - land_of(s);
    if (width < 4 || width % 2 != 0)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} leaves {} of the period's {} cells to the ridge, which needs "
                                "an even number of at least 4",
                                land_of(s), width, s.period),
                    "land");
}

/// A ridge is the arc of a circle of radius r = w / (2 sin(tilt)), w its width: the slope at a
/// distance x from its crest is -x / sqrt(r^2 - x^2), tan(tilt) at its feet. The tilt of a level
/// projected area is therefore distributed evenly in its sine, from 0 to that of the feet.
void fill_ridges(Heightfield& surface, const SurfaceSettings& s, Run& run) {
    const auto width = static_cast<int>(s.period - land_of(s));
    const double sine = std::sin(radians(s.tilt_deg)), cosine = std::cos(radians(s.tilt_deg));
    const auto arc = [=, period = s.period](int i, double step) {
        const int phase = i % period;
        if (phase >= width || sine == 0) return 0.0;
        const double radius = 0.5 * width * step / sine;
        const double t = (2.0 * phase / width - 1) * sine;  // the sine of the tilt at this sample
        return radius * (std::sqrt((1 - t) * (1 + t)) - cosine);
    };
    fill_one_way(surface, s, arc, run);
}

}  // namespace

SurfaceKind ridges() {
    return {
        .name = "ridges",
        .label = "Rounded ridges",
        .doc = "arcs of a circle side by side, level land between them",
        .params = {"tilt", "period", "along-y"},
        .own = {own_field<std::int64_t>({.name = "land",
                                         .unit = "cells",
                                         .range = {0, kMaxSurfaceSide - 4},
                                         .doc = "level part of a period, between two ridges"},
                                        0)},
        .fill = fill_ridges,
        .check = check_ridges,
        .describe =
            [](const SurfaceSettings& s) {
                return fmt::format("ridges, up to {} degrees, period {}, land {}{}", s.tilt_deg,
                                   s.period, land_of(s), s.along_y ? ", along y" : "");
            },
    };
}

}  // namespace asperity::generators
