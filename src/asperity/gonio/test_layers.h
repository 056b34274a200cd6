// SPDX-License-Identifier: Apache-2.0
// Hand-made layers for tests: what each cell holds is known.
#pragma once

#include <asperity/core/energy.h>
#include <asperity/gonio/measurement.h>

#include <string>
#include <vector>

namespace asperity::test {

/// A measurement without energy: one layer a polar angle, 1000 rays each, three bounce orders.
inline Measurement empty_measurement(DetectorKind kind, int resolution,
                                     std::vector<std::string> channels,
                                     const std::vector<double>& theta_deg) {
    Measurement m;
    m.experiment.detector = {kind, resolution, 3};
    m.experiment.run.bounces = 8;
    m.experiment.illumination.theta_deg = theta_deg;
    m.detector = Detector(m.experiment.detector);
    m.channel_names = std::move(channels);
    m.surface_name = "hand-made";
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const std::size_t n = m.channel_names.size();
    int number = 0;
    for (const double theta : theta_deg) {
        Layer layer;
        layer.number = ++number;
        layer.theta_i = radians(theta);
        layer.rays = 1000;
        layer.energy.assign(3 * n * cells, 0);
        layer.escaped.assign(n, 0);
        layer.escaped_by_bounce.assign(8 * n, 0);
        layer.stderr_energy.assign(n * cells, 0.0F);
        m.layers.push_back(layer);
    }
    return m;
}

/// Adds `rays` rays of full energy to a cell.
inline void add_rays(Measurement& m, Layer& layer, int order, int channel, int cell, double rays) {
    const auto slice = static_cast<std::size_t>(order * m.channels() + channel);
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const auto energy = static_cast<std::uint64_t>(rays * static_cast<double>(kRayEnergy));
    layer.energy[slice * cells + static_cast<std::size_t>(cell)] += energy;
    layer.escaped[static_cast<std::size_t>(channel)] += energy;
}

}  // namespace asperity::test
