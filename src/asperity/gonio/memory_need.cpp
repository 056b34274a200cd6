// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/memory_need.h>

#include <asperity/core/memory.h>
#include <asperity/detector/detector.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/optics/fresnel.h>

#include <algorithm>

namespace asperity {

std::uint64_t memory_needed(const Heightfield& surface, const Experiment& e) {
    // In floating point: a product of limits may not fit
    const Detector detector(e.detector);
    const double cells = detector.cells() * static_cast<double>(Fresnel(e.optics).channels());
    const double orders = std::min(e.detector.orders, e.run.bounces);
    const double angles = e.illumination.theta_deg.empty()
                              ? e.illumination.layers
                              : static_cast<double>(e.illumination.theta_deg.size());
    const double layers = angles * static_cast<double>(e.illumination.phi_deg.size());
    // Energies by order, squares of their sum, batches that reached a cell; sums by groups of
    // batches; of a layer also the errors
    const CoarseGrid grid({.cells = static_cast<std::size_t>(detector.cells()),
                           .columns = static_cast<std::size_t>(detector.columns())});
    const double groups = GroupSums::kGroups * static_cast<double>(grid.blocks()) *
                          static_cast<double>(Fresnel(e.optics).channels());
    const double sums =
        cells * (orders * sizeof(std::uint64_t) + sizeof(LayerSums::Wide) + sizeof(std::uint32_t)) +
        groups * sizeof(std::uint64_t);
    const double layer = sums + cells * sizeof(float);
    // The wide engine's heights and horizons
    constexpr double kBytesACell = 6;
    const double engine =
        e.run.engine == "plain" ? 0 : kBytesACell * static_cast<double>(surface.cell_count());
    constexpr double kMost = 0x1p63;
    return static_cast<std::uint64_t>(std::min(layers * layer + sums + engine, kMost));
}

void require_memory_for(const Heightfield& surface, const Experiment& experiment) {
    require_memory(memory_needed(surface, experiment), "the measurement");
}

}  // namespace asperity
