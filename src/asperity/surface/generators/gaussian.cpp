// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/gaussian.h>

#include <asperity/surface/generators/builtin_kinds.h>
#include <asperity/surface/generators/random_field.h>

namespace asperity::generators {

SurfaceKind gaussian() {
    return {
        .name = "gaussian",
        .label = "Gaussian",
        .doc = "Gaussian random heights of given alpha and autocorrelation",
        .params = {"alpha", "correlation-length", "autocorrelation", "hurst", "surface-seed"},
        .fill =
            [](Heightfield& surface, const SurfaceSettings& s, Run& run) {
                fill_random_field(surface, s, run);
                rescale_to_gradient(surface, asked_rms_gradient(s), run);
            },
        .check = check_correlation,
        .steps = random_field_steps,
        .isotropic = random_field_is_isotropic,
        .describe = random_field_name,
    };
}

}  // namespace asperity::generators
