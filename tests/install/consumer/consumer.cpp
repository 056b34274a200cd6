// SPDX-License-Identifier: Apache-2.0
// A stranger's program: all light that falls on flat perfect mirrors leaves again.
#include <asperity/core/version.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <cstdio>

int main() {
    asperity::Experiment experiment;
    experiment.surface.kind = "flat";
    experiment.surface.size = 16;
    experiment.illumination.theta_deg = {30};

    asperity::Run run;
    const asperity::Heightfield surface = asperity::make_surface(experiment.surface, run);
    const asperity::Measurement result = asperity::measure(surface, experiment, run);
    std::printf("asperity %s\nalbedo %f\n", asperity::kVersion, result.albedo(result.layers[0], 0));
}
