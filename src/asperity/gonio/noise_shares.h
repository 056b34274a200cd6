// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measurement.h>

#include <optional>
#include <span>

namespace asperity {

/// Where squared standard errors come from: shares of the rays, in [0, 1]; the rest is between
/// surfaces.
struct NoiseShares {
    double albedo = 0;
    double cells = 0;  ///< of the sum over all cells of the squared errors of their energy
};

/// Of some layers and all their channels together; nothing where one surface was measured.
/// Estimates from the differences between the halves of each surface's rays: of n surfaces, that of
/// one layer's albedo is right to about sqrt(4 / n) of itself, that of the cells to far less.
std::optional<NoiseShares> shares_of_rays(std::span<const Layer> layers);

/// What that of cells is told from. Nothing where one surface was measured.
std::optional<CellNoise> cell_noise_of(const Layer& layer);

/// The part of a layer's standard errors that the rays make: of the albedo, and of the energy of a
/// cell (fractions of the launched energy). All of them where one surface was measured.
double albedo_error_of_rays(const Layer& layer, int channel);
double energy_error_of_rays(const Layer& layer, std::size_t channel_and_cell);

}  // namespace asperity
