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

/// Sums of squares: of the rays, and of both.
struct Parts {
    double rays = 0, both = 0;
    void add(double of_rays, double of_both) {
        rays += of_rays * of_rays;
        both += of_both * of_both;
    }
    double share() const { return both > 0 ? std::min(1.0, rays / both) : 0.0; }
};

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

std::optional<NoiseShares> shares_of_rays(std::span<const Layer> layers) {
    Parts albedo, cells;
    for (const Layer& layer : layers) {
        const LayerSums::Halves& halves = layer.spread.halves;
        // One surface alone does not tell how others differ
        if (halves.cells.empty() || layer.batches < 2) return std::nullopt;
        for (std::size_t c = 0; c < halves.albedo.size(); ++c)
            albedo.add(error_of(halves.albedo[c], layer), layer.stderr_albedo[c]);
        for (std::size_t k = 0; k < halves.cells.size(); ++k)
            cells.add(error_of(halves.cells[k], layer), double{layer.stderr_energy[k]});
    }
    if (layers.empty()) return std::nullopt;
    return NoiseShares{albedo.share(), cells.share()};
}

}  // namespace asperity
