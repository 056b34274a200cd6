// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parallel.h>
#include <asperity/measured/compare.h>
#include <asperity/measured/row_integrator.h>

#include <cmath>
#include <optional>

namespace asperity {
namespace {

/// Where the plane of incidence runs along edges of columns or through their middles, the columns
/// are mirrored in it two by two: the sum of the numbers of such a pair, less a whole turn where it
/// can be, by which one finds the other. None where it cuts them otherwise, or where the BRDF is
/// not alike on both sides.
std::optional<int> sum_of_mirrored(const Bsdf& brdf, const Detector& detector, double phi_i) {
    if (!brdf.isotropic() || !brdf.bilateral()) return std::nullopt;
    const int columns = detector.columns();
    const double halves = phi_i / kPi * columns;  // half columns
    const double whole = std::round(halves);
    if (std::abs(halves - whole) > 1e-9) return std::nullopt;
    return (static_cast<int>(std::fmod(whole, columns)) - 1 + columns) % columns;
}

}  // namespace

CellAverages average_over_cells(const Bsdf& brdf, const Detector& detector, double theta_i,
                                double phi_i, bool isotropic, int threads) {
    const std::size_t channels = static_cast<std::size_t>(brdf.channels());
    const std::size_t columns = static_cast<std::size_t>(detector.columns());
    const std::size_t cells = static_cast<std::size_t>(detector.cells());
    const detail::CellIntegrator integrator(brdf, detector, theta_i, phi_i, isotropic);

    const auto mirrored = sum_of_mirrored(brdf, detector, isotropic ? 0.0 : phi_i);

    // A column and the one mirrored in it
    std::vector<int> own, others;
    for (int column = 0; column < detector.columns(); ++column) {
        const int other =
            mirrored ? (*mirrored + detector.columns() - column) % detector.columns() : column;
        if (other < column) continue;
        own.push_back(column);
        others.push_back(other);
    }
    const detail::RowIntegrator rows(integrator, detector, own);

    CellAverages result;
    result.energy.assign(channels * cells, 0.0);
    parallel_for(static_cast<std::size_t>(detector.rows()), threads, [&](std::size_t row) {
        std::vector<double> energy(own.size() * channels);
        rows.integrate(static_cast<int>(row), energy);
        for (std::size_t channel = 0; channel < channels; ++channel) {
            double* const to = &result.energy[channel * cells + row * columns];
            for (std::size_t k = 0; k < own.size(); ++k)
                to[own[k]] = to[others[k]] = energy[k * channels + channel];
        }
    });

    result.albedo.assign(channels, 0.0);
    for (std::size_t channel = 0; channel < channels; ++channel)
        for (std::size_t cell = 0; cell < cells; ++cell)
            result.albedo[channel] += result.energy[channel * cells + cell];
    return result;
}

}  // namespace asperity
