// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/surface_class.h>

#include <asperity/core/error.h>
#include <asperity/core/memory.h>
#include <asperity/surface/digest.h>
#include <asperity/surface/make_surface.h>
#include <asperity/tracing/scale.h>

#include <algorithm>
#include <utility>

namespace asperity {

SurfaceClass::SurfaceClass(const EngineSetup& setup, Settings settings, const Run& run)
    : setup_(setup), settings_(std::move(settings)), first_(made(0, run, run.threads())) {
    if (!first_) throw Error(ErrorCode::Stopped, "stopped");
    if (digest(first_->heights) != digest(setup.surface))
        throw Error(ErrorCode::Usage,
                    "the surface is not the one that its settings make, so they tell of no others",
                    "surfaces");
    const std::size_t bytes =
        first_->heights.heights.size() * sizeof(float) + first_->engine->memory_bytes();
    kept_ = settings_.most_bytes / bytes;
}

std::size_t SurfaceClass::bytes_to_keep() {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 30;
    const auto room = memory_room();
    return static_cast<std::size_t>(room ? std::min(kMost, room->bytes / 4) : kMost);
}

std::shared_ptr<const SurfaceClass::Surface> SurfaceClass::made(std::uint64_t number,
                                                                const Run& run, int threads) const {
    // What is told of the run is its rays; it stops, and so does this
    Run own(threads);
    own.on_progress([&](const Progress&) {
        if (run.stop_requested()) own.request_stop();
    });
    try {
        SurfaceSettings settings = settings_.surface;
        settings.seed += number;
        auto surface = std::make_shared<Surface>(make_surface(settings, own), setup_);
        const auto& heights = surface->heights.heights;
        const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
        check_scale(surface->heights, double{*lowest}, double{*highest}, settings_.theta_i);
        own.begin("preparing", surface->heights.cell_count());
        surface->engine = settings_.engine.make(surface->setup, own);
        return surface;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::Stopped) throw;
        return nullptr;
    }
}

std::shared_ptr<const SurfaceClass::Surface> SurfaceClass::surface(std::uint64_t number,
                                                                   const Run& run) {
    if (number == 0) return first_;
    if (number >= kept_) return made(number, run, 1);
    Place* place = nullptr;
    {
        const std::scoped_lock lock(mutex_);
        place = &places_[number];
    }
    const std::scoped_lock lock(place->mutex);
    if (!place->surface) place->surface = made(number, run, 1);
    return place->surface;
}

bool SurfaceClass::trace(const Incidence& incidence, const BatchRequest& request, Worker& worker,
                         BatchSums& first, BatchSums& second, Run& run) {
    const auto on = surface(request.index, run);
    if (!on) return false;
    // Beside what it costs to make a surface, what all its rays have in common is soon worth a look
    constexpr std::uint64_t kRayIsWorth = 32;
    const auto lit =
        on->engine->light(incidence, request.pattern, kRayIsWorth * request.rays, run, 1);
    if (run.stop_requested()) return false;
    BatchRequest half = request;
    half.rays = request.rays / 2;
    half.index = 2 * request.index;
    if (!lit->trace(half, worker, first, run)) return false;
    ++half.index;
    return lit->trace(half, worker, second, run);
}

}  // namespace asperity
