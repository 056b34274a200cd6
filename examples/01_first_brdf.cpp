// SPDX-License-Identifier: Apache-2.0
// A rough gold surface, measured at 0 and 60 degrees.
#include <asperity/core/run.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>

#include <cstdio>

int main() {
    asperity::Experiment experiment;
    experiment.surface.kind = "gaussian";
    experiment.surface.size = 256;
    experiment.optics.fresnel = asperity::FresnelKind::Conductor;
    experiment.optics.material = "Au";
    experiment.illumination.theta_deg = {0, 60};

    asperity::Run run;
    const auto surface = asperity::make_surface(experiment.surface, run);
    const auto m = asperity::measure(surface, experiment, run);
    std::printf("albedo at 60 degrees: %.3f +- %.4f (green)\n", m.albedo(m.layers[1], 1),
                m.layers[1].stderr_albedo[1]);
}
