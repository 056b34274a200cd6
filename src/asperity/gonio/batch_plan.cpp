// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_plan.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

BatchPlan::BatchPlan(std::uint64_t cells, const RunSettings& run) {
    const double jitter = jitter_of(run, cells), wanted = rays_wanted(run, cells);
    if (wanted > static_cast<double>(kMaxRaysPerLayer))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} launch points per cell are {:.3g} rays a layer, more than {}",
                                jitter, wanted, kMaxRaysPerLayer),
                    "jitter");
    rays = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::llround(wanted)));
    batches = std::min<std::uint64_t>(static_cast<std::uint64_t>(run.batches), rays);
    batches = std::max(batches, (rays + kLargestBatch - 1) / kLargestBatch);
    if (const std::uint64_t surfaces = surfaces_of(run, cells); surfaces > 1)
        share_out_to(surfaces);
    limit = run.max_rays > 0 ? run.max_rays : std::min(kMaxRaysPerLayer, 256 * rays);
    // Random numbers are told apart by 2^24 batches, or halves of them
    constexpr std::uint64_t kMostSurfaces = 1 << 23;
    if (of_class) limit = std::min(limit, kMostSurfaces * largest());
}

void BatchPlan::share_out_to(std::uint64_t surfaces) {
    const auto refuse = [&](const char* what, std::uint64_t bound, std::uint64_t best) {
        throw Error(
            ErrorCode::Usage,
            fmt::format("{} rays a layer leave each of {} surfaces {} than {} rays: ask "
                        "for {} {} surfaces",
                        rays, surfaces, what, bound, *what == 'f' ? "at most" : "at least", best),
            "surfaces");
    };
    if (rays < 2 * surfaces) refuse("fewer", 2, std::max<std::uint64_t>(1, rays / 2));
    // Halves of a batch are compared, so they have as many rays each
    const std::uint64_t each = 2 * ((rays + surfaces) / (2 * surfaces));
    if (each > kLargestBatch)
        refuse("more", kLargestBatch, (rays + kLargestBatch - 1) / kLargestBatch);
    of_class = true;
    batches = surfaces;
    rays = each * surfaces;
}

BatchRange BatchPlan::round_of(std::uint64_t end) const {
    BatchRange round{0, batches};
    while (round.end < end) {
        const std::uint64_t added = more(round.end, rays_before(round.end));
        if (added == 0) break;
        round = {round.end, round.end + added};
    }
    return round;
}

std::uint64_t BatchPlan::more(std::uint64_t so_far, std::uint64_t of_rays) const {
    return std::min(so_far, (limit - std::min(limit, of_rays)) / largest());
}

}  // namespace asperity
