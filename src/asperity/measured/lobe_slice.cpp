// SPDX-License-Identifier: Apache-2.0
#include <asperity/measured/lobe_slice.h>

#include <asperity/bsdf/channel_range.h>
#include <asperity/core/directions.h>
#include <asperity/measured/patch_integrator.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

struct ColumnShare {
    int column = 0;
    double weight = 0;  ///< share of the column that lies in the strip
};

/// The columns of `row` in the strip about the half-plane of azimuth `phi`, `wide` columns to
/// either side at the horizon.
std::vector<ColumnShare> columns_in_strip(const Detector& detector, int row, double phi,
                                          double wide) {
    constexpr double kNothing = 1e-9;
    const int count = detector.columns();
    const double width = 2 * kPi / count;
    // A quarter turn to either side at most: beyond lies the other side of the normal.
    const double half =
        std::min(kPi / 2, wide * width / std::sin(detector.theta_centre(row))) / width;
    const double first = phi / width - half, last = phi / width + half;
    std::vector<ColumnShare> columns;
    for (int k = static_cast<int>(std::floor(first)); k < last; ++k) {
        const double weight = std::min(last, k + 1.0) - std::max(first, 1.0 * k);
        if (weight > kNothing) columns.push_back({((k % count) + count) % count, weight});
    }
    return columns;
}

/// Energy that fell into a cell, and its standard error, as fractions of the launched energy.
struct CellEnergy {
    double value = 0, error = 0;
};

/// The slice of whatever energy_of(row, column) gives.
template <class EnergyOf>
LobeSlice slice_of(const Detector& detector, const Layer& layer, const LobeCut& cut,
                   const EnergyOf& energy_of) {
    const int rows = detector.rows();
    LobeSlice slice{layer.theta_i, layer.phi_i, {}};
    for (int k = 0; k < 2 * rows; ++k) {
        const bool light_side = k < rows;
        const int row = light_side ? rows - 1 - k : k - rows;
        const double phi = layer.phi_i + cut.azimuth + (light_side ? 0 : kPi);
        double energy = 0, variance = 0, weights = 0;
        for (const auto& [column, weight] : columns_in_strip(detector, row, phi, cut.columns)) {
            const CellEnergy cell = energy_of(row, column);
            energy += weight * cell.value;
            variance += weight * weight * cell.error * cell.error;
            weights += weight;
        }
        const double error = std::sqrt(variance);
        const double projected = weights * detector.projected_solid_angle(row);
        const double solid = weights * detector.solid_angle(row);
        const double theta = detector.theta_centre(row);
        slice.samples.push_back({light_side ? -theta : theta,
                                 detector.cell_of(from_spherical(theta, phi)), energy / projected,
                                 error / projected, energy / solid, error / solid});
    }
    return slice;
}

}  // namespace

LobeSlice lobe_slice(const Measurement& measurement, const Layer& layer, int channel,
                     const LobeCut& cut) {
    const Detector& detector = measurement.detector;
    const auto [first, last] = detail::channel_range(channel, measurement.channels());
    const std::size_t cells = static_cast<std::size_t>(detector.cells());
    return slice_of(
        detector, layer, cut, [&, first = first, last = last](int row, int column) -> CellEnergy {
            const int cell = row * detector.columns() + column;
            CellEnergy sum;
            for (int c = first; c < last; ++c) {
                sum.value += measurement.energy(layer, c, cell);
                const std::size_t k = static_cast<std::size_t>(c) * cells;
                if (!layer.stderr_energy.empty())
                    sum.error += double{layer.stderr_energy[k + static_cast<std::size_t>(cell)]};
            }
            return {sum.value / (last - first), sum.error / (last - first)};
        });
}

LobeSlice lobe_slice(const Bsdf& brdf, const Measurement& measurement, const Layer& layer,
                     int channel, const LobeCut& cut) {
    const auto [first, last] = detail::channel_range(channel, brdf.channels());
    const detail::CellIntegrator integrator(brdf, measurement.detector, layer.theta_i, layer.phi_i,
                                            measurement.experiment.illumination.isotropic);
    return slice_of(measurement.detector, layer, cut,
                    [&, first = first, last = last](int row, int column) -> CellEnergy {
                        const detail::Channels energy = integrator.integrate(row, column);
                        double sum = 0;
                        for (int c = first; c < last; ++c)
                            sum += energy[static_cast<std::size_t>(c)];
                        return {sum / (last - first), 0};
                    });
}

}  // namespace asperity
