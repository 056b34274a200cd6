// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/noise_shares.h>

#include <asperity/core/energy.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

double error_of(LayerSums::Wide halves, const Layer& layer) {
    return std::sqrt(static_cast<double>(halves)) /
           (static_cast<double>(kRayEnergy) * static_cast<double>(layer.rays));
}

void add(CellNoise& sums, double of_rays, double of_both) {
    sums.rays += of_rays * of_rays;
    sums.both += of_both * of_both;
}

double share(const CellNoise& sums) {
    return sums.both > 0 ? std::min(1.0, sums.rays / sums.both) : 0.0;
}

}  // namespace

double albedo_error_of_rays(const Layer& layer, int channel) {
    const auto c = static_cast<std::size_t>(channel);
    const auto& halves = layer.spread.halves.albedo;
    return halves.empty() ? layer.stderr_albedo[c] : error_of(halves[c], layer);
}

double energy_error_of_rays(const Layer& layer, std::size_t k) {
    const auto& halves = layer.spread.halves.cells;
    return halves.empty() ? double{layer.stderr_energy[k]} : error_of(halves[k], layer);
}

std::optional<CellNoise> cell_noise_of(const Layer& layer) {
    const LayerSums::Halves& halves = layer.spread.halves;
    if (halves.cells.empty()) return layer.spread.cell_noise;
    CellNoise sums;
    for (std::size_t k = 0; k < halves.cells.size(); ++k)
        add(sums, error_of(halves.cells[k], layer), double{layer.stderr_energy[k]});
    return sums;
}

std::optional<NoiseShares> shares_of_rays(std::span<const Layer> layers) {
    CellNoise albedo, cells;
    for (const Layer& layer : layers) {
        const auto noise = cell_noise_of(layer);
        // One surface alone does not tell how others differ
        if (!noise || layer.batches < 2) return std::nullopt;
        const auto& halves = layer.spread.halves.albedo;
        for (std::size_t c = 0; c < halves.size(); ++c)
            add(albedo, error_of(halves[c], layer), layer.stderr_albedo[c]);
        cells.rays += noise->rays;
        cells.both += noise->both;
    }
    if (layers.empty()) return std::nullopt;
    return NoiseShares{share(albedo), share(cells)};
}

}  // namespace asperity
