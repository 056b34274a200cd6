// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/ggx.h>

#include <asperity/core/error.h>
#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/random_field.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity::generators {

namespace {

void check_ggx(const SurfaceSettings& s) {
    if (s.correlation_x != s.correlation_y)
        throw Error(ErrorCode::Usage,
                    "ggx takes one length; the one along y follows from the ratio of the alphas",
                    "correlation-length");
    const double alpha = std::max(s.alpha_x, s.alpha_y);
    if (s.max_slope <= alpha)
        throw Error(ErrorCode::Usage, fmt::format("{} is not above alpha, {}", s.max_slope, alpha),
                    "max-slope");
    check_correlation(s);
}

}  // namespace

SurfaceKind ggx() {
    return {
        .name = "ggx",
        .label = "GGX",
        .doc = "random heights whose facet normals follow GGX",
        .params = {"alpha", "correlation-length", "autocorrelation", "hurst", "max-slope",
                   "surface-seed"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                fill_random_field(surface, s, run);
                impose_slope_law(surface, {SlopeFamily::Ggx, s.alpha_x, s.alpha_y, s.max_slope},
                                 kGgxRounds, run);
            },
        .check = check_ggx,
        .steps =
            [](const SurfaceSettings& s) {
                return random_field_steps(s) + kGgxRounds * impose_steps(s.size, s.size);
            },
        .isotropic = random_field_is_isotropic,
        .describe = random_field_name,
        .bytes_per_sample = 8,
    };
}

}  // namespace asperity::generators
