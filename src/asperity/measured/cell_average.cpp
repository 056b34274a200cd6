// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/patch_integrator.h>

namespace asperity {

CellAverages average_over_cells(const Bsdf& brdf, const Detector& detector, double theta_i,
                                double phi_i, bool isotropic, int threads) {
    const std::size_t channels = static_cast<std::size_t>(brdf.channels());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cells = static_cast<std::size_t>(detector.cells());
    const detail::CellIntegrator integrator(brdf, detector, theta_i, phi_i, isotropic);

    CellAverages result;
    result.energy.assign(channels * cells, 0.0);
    parallel_for(static_cast<std::size_t>(detector.rows()), threads, [&](std::size_t row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const detail::Channels energy =
                integrator.integrate(static_cast<int>(row), static_cast<int>(column));
            for (std::size_t channel = 0; channel < channels; ++channel)
                result.energy[channel * cells + row * columns + column] = energy[channel];
        }
    });

    result.albedo.assign(channels, 0.0);
    for (std::size_t channel = 0; channel < channels; ++channel)
        for (std::size_t cell = 0; cell < cells; ++cell)
            result.albedo[channel] += result.energy[channel * cells + cell];
    return result;
}

}  // namespace asperity
