// SPDX-License-Identifier: Apache-2.0
#pragma once

// A measurement without noise, for the tests of this folder.

#include <asperity/core/directions.h>
#include <asperity/core/energy.h>
#include <asperity/measured/compare.h>
#include <asperity/tracing/launch.h>

namespace asperity::test {

/// What a perfect instrument would measure of `brdf`: the energies of the cells, rounded to the
/// units of a Layer, with no error bars. The illumination and the detector of `experiment` decide.
inline Measurement measurement_of(const Bsdf& brdf, Experiment experiment) {
    experiment.detector.orders = 1;
    experiment.run.bounces = 1;
    Measurement m;
    m.detector = Detector(experiment.detector);
    m.surface_name = brdf.name();
    for (int c = 0; c < brdf.channels(); ++c) m.channel_names.push_back("c" + std::to_string(c));
    for (const Incidence& light : incidences(experiment.illumination)) {
        Layer layer;
        layer.number = light.number;
        layer.theta_i = light.theta;
        layer.phi_i = light.phi;
        layer.rays = 1u << 20;
        const CellAverages averages =
            average_over_cells(brdf, m.detector, light.theta, light.phi, light.isotropic, 2);
        layer.escaped.assign(averages.albedo.size(), 0);
        const double unit = static_cast<double>(kRayEnergy) * static_cast<double>(layer.rays);
        for (std::size_t k = 0; k < averages.energy.size(); ++k) {
            layer.energy.push_back(static_cast<std::uint64_t>(averages.energy[k] * unit + 0.5));
            layer.escaped[k / static_cast<std::size_t>(m.detector.cells())] += layer.energy.back();
        }
        layer.escaped_by_bounce = layer.escaped;
        m.layers.push_back(std::move(layer));
    }
    m.experiment = experiment;
    return m;
}

}  // namespace asperity::test
