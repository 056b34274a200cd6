// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/measurement.h>

#include <asperity/core/energy.h>
#include <asperity/core/index.h>

#include <algorithm>

namespace asperity {

int Measurement::orders() const {
    return std::min(experiment.detector.orders, experiment.run.bounces);
}

SumShape Measurement::shape() const {
    return {index(detector.cells()), index(detector.sides()), index(channels()),        1,
            index(orders()),         index(bounces()),        index(detector.columns())};
}

double Measurement::energy(const Layer& layer, int order, int channel, int cell) const {
    const std::size_t slice = index(order) * index(channels()) + index(channel);
    return energy_fraction(layer.energy[slice * index(detector.cells()) + index(cell)], layer.rays);
}

double Measurement::energy(const Layer& layer, int channel, int cell) const {
    std::uint64_t sum = 0;
    for (int order = 0; order < orders(); ++order) {
        const std::size_t slice = index(order) * index(channels()) + index(channel);
        sum += layer.energy[slice * index(detector.cells()) + index(cell)];
    }
    return energy_fraction(sum, layer.rays);
}

std::vector<double> Measurement::energies(const Layer& layer, int channel) const {
    const std::size_t cells = index(detector.cells());
    std::vector<std::uint64_t> sums(cells);
    std::uint64_t* const sum = sums.data();
    for (int order = 0; order < orders(); ++order) {
        const std::size_t slice = index(order) * index(channels()) + index(channel);
        const std::uint64_t* const energy = layer.energy.data() + slice * cells;
        for (std::size_t cell = 0; cell < cells; ++cell) sum[cell] += energy[cell];
    }
    std::vector<double> fractions(cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
        fractions[cell] = energy_fraction(sum[cell], layer.rays);
    return fractions;
}

double Measurement::brdf(const Layer& layer, int channel, int cell) const {
    return energy(layer, channel, cell) / detector.projected_solid_angle(cell / detector.columns());
}

double Measurement::brdf_stderr(const Layer& layer, int channel, int cell) const {
    const std::size_t k = index(channel) * index(detector.cells()) + index(cell);
    return double{layer.stderr_energy[k]} /
           detector.projected_solid_angle(cell / detector.columns());
}

double Measurement::albedo(const Layer& layer, int channel) const {
    return energy_fraction(layer.escaped[index(channel)], layer.rays);
}

double Measurement::albedo(const Layer& layer, int order, int channel) const {
    const std::size_t k = index(channel) * index(bounces()) + index(order);
    return energy_fraction(layer.escaped_by_bounce[k], layer.rays);
}

}  // namespace asperity
