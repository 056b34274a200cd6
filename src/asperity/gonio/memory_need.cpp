// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/memory_need.h>

#include <asperity/core/memory.h>
#include <asperity/detector/detector.h>
#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/surface_class.h>
#include <asperity/optics/fresnel.h>

#include <algorithm>

namespace asperity {

namespace {

/// What SurfaceClass keeps: every surface with its engine, or as many as it has room for, but the
/// first one always; 0 where there is one surface, which is there already.
double bytes_of_class(const Heightfield& surface, const Experiment& e, double engine) {
    const auto surfaces = static_cast<double>(surfaces_of(e.run, surface.cell_count()));
    if (surfaces < 2) return 0;
    const double each = static_cast<double>(surface.heights.size() * sizeof(float)) + engine;
    return std::min(surfaces * each,
                    std::max(each, static_cast<double>(SurfaceClass::bytes_to_keep())));
}

}  // namespace

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
    const double made = bytes_of_class(surface, e, engine);
    constexpr double kMost = 0x1p63;
    return static_cast<std::uint64_t>(
        std::min(layers * layer + sums + std::max(engine, made), kMost));
}

void require_memory_for(const Heightfield& surface, const Experiment& experiment) {
    require_memory(memory_needed(surface, experiment), "the measurement");
}

}  // namespace asperity
