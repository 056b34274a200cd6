// SPDX-License-Identifier: Apache-2.0
// A kind of surface of your own: one row, and settings as text, measurements and files know it.
#include <asperity/core/run.h>
#include <asperity/gonio/measure.h>
#include <asperity/surface/make_surface.h>
#include <asperity/surface/surface_kinds.h>
#include <asperity/surface/surface_text.h>

#include <cmath>
#include <cstdio>

namespace {

/// Level steps along x: `period` cells each, `rise` cells higher than the last, four to a flight.
asperity::SurfaceKind terraces() {
    asperity::SurfaceKind kind;
    kind.name = "terraces";
    kind.label = "Terraces";
    kind.doc = "level steps, four to a flight";
    kind.params = {"period"};
    kind.own = {asperity::own_field<double>(
        {.name = "rise", .unit = "cells", .range = {0, 100}, .doc = "height of a step"}, 1.0)};
    kind.fill = [](asperity::Heightfield& surface, const asperity::SurfaceSettings& settings,
                   asperity::Run& run) {
        const double rise = asperity::own(settings, "rise", 1.0);
        for (int j = 0; j < surface.ny; ++j) {
            for (int i = 0; i < surface.nx; ++i)
                surface.heights[static_cast<std::size_t>(j * surface.nx + i)] =
                    static_cast<float>(rise * (i / settings.period % 4));
            run.advance(1);
        }
    };
    return kind;
}

}  // namespace

int main() {
    asperity::add_surface_kind(terraces());

    asperity::Experiment experiment;
    asperity::apply_surface_spec(experiment.surface, "terraces:period=16,rise=0.5,size=128");
    experiment.illumination.theta_deg = {0};
    experiment.detector.resolution = 32;

    asperity::Run run;
    const asperity::Heightfield surface = asperity::make_surface(experiment.surface, run);
    const asperity::Measurement brdf = asperity::measure(surface, experiment, run);
    std::printf("%s\n", brdf.surface_name.c_str());
    std::printf("albedo at normal incidence: %.4f\n", brdf.albedo(brdf.layers[0], 0));
}
