// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/detector/batch_sums.h>
#include <asperity/surface/heightfield.h>
#include <asperity/surface/surface_settings.h>
#include <asperity/tracing/engine.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace asperity {

/// Surfaces of one kind: number b is the one that the settings describe with the surface-seed
/// S + b. Each is made by the thread that needs it first, and kept as long as there is room for all
/// that went before: the others are made again for each layer. All functions may be called from any
/// thread.
class SurfaceClass {
  public:
    struct Settings {
        SurfaceSettings surface;
        EngineKind engine;
        std::vector<double> theta_i;  ///< of all light [rad], for check_scale()
        std::size_t most_bytes = 0;   ///< for surfaces that are kept
    };
    /// Makes the first surface, on the threads of `run`: the engines see light as `setup` says.
    /// Throws Error(Usage, "surfaces") unless it is setup.surface to the bit, as the settings then
    /// tell nothing of what is measured; Error(Stopped).
    SurfaceClass(const EngineSetup& setup, Settings settings, const Run& run);

    /// Bytes that kept surfaces may take: a quarter of what there is, 1 GiB at most.
    static std::size_t bytes_to_keep();

    /// For one thread and all surfaces.
    std::unique_ptr<Worker> worker() const { return first_->engine->worker(); }

    /// Traces batch request.index, half of its even number of rays after the other, on the surface
    /// of that number. False if the run was stopped: the sums then hold a part.
    bool trace(const Incidence& incidence, const BatchRequest& request, Worker& worker,
               BatchSums& first, BatchSums& second, Run& run);

  private:
    struct Surface {
        Surface(Heightfield made, const EngineSetup& like)
            : heights(std::move(made)), setup{heights, like.fresnel, like.detector, like.bounces} {}
        const Heightfield heights;
        const EngineSetup setup;
        std::unique_ptr<Engine> engine;
    };
    /// A surface that is kept, once it is made.
    struct Place {
        std::mutex mutex;
        std::shared_ptr<const Surface> surface;
    };
    std::shared_ptr<const Surface> made(std::uint64_t number, const Run& run, int threads) const;
    std::shared_ptr<const Surface> surface(std::uint64_t number, const Run& run);

    const EngineSetup setup_;
    const Settings settings_;
    std::shared_ptr<const Surface> first_;
    std::uint64_t kept_ = 0;  ///< surfaces of lower numbers are
    std::mutex mutex_;        ///< guards the map
    std::map<std::uint64_t, Place> places_;
};

}  // namespace asperity
