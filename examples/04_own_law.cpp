// SPDX-License-Identifier: Apache-2.0
// Facets of your own: how much light a facet reflects, as a row. Both engines take it, and so do
// the microfacet models.
#include <asperity/core/run.h>
#include <asperity/gonio/measure.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/optics/scattering_law.h>
#include <asperity/surface/make_surface.h>

#include <cstdio>

namespace {

/// Facets that reflect the same share of the light at every angle, f0, one or per channel.
asperity::ScatteringLaw grey_law() {
    asperity::ScatteringLaw law;
    law.name = "grey";
    law.label = "Grey mirrors";
    law.doc = "f0 at every angle";
    law.channels = [](const asperity::OpticsSettings& s) {
        std::vector<asperity::FacetChannel> channels;
        for (const double f0 : s.f0) channels.push_back({f0, 1, 0});
        return channels;
    };
    law.reflectance = [](double, const asperity::FacetChannel& channel) { return channel.f0; };
    return law;
}

/// Shares of the light that leave after one reflection and after two.
asperity::AlbedoByBounce orders_of(const asperity::Experiment& experiment) {
    asperity::Run run;
    const asperity::Measurement m =
        asperity::measure(asperity::make_surface(experiment.surface, run), experiment, run);
    return asperity::albedo_by_bounce(m, m.layers[0], 3, -1);
}

}  // namespace

int main() {
    const asperity::FresnelKind grey = asperity::add_scattering_law(grey_law());

    asperity::Experiment experiment;
    experiment.surface.size = 64;
    experiment.surface.roughness = 1;
    experiment.illumination.theta_deg = {60};
    experiment.detector.resolution = 32;
    for (const char* engine : {"wide", "plain"}) {
        experiment.run.engine = engine;
        experiment.optics = {};
        const auto perfect = orders_of(experiment);
        experiment.optics.fresnel = grey;
        experiment.optics.f0 = {0.5};
        const auto grey_ones = orders_of(experiment);
        // Each reflection leaves half of the light.
        std::printf("%s: what is left after one reflection %.4f, after two %.4f\n", engine,
                    grey_ones.order[0].value / perfect.order[0].value,
                    grey_ones.order[1].value / perfect.order[1].value);
    }
}
