// SPDX-License-Identifier: Apache-2.0
#include <asperity/gonio/batch_plan.h>

#include <asperity/core/energy.h>
#include <asperity/core/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {
/// A batch larger than this is split: a stopped run loses the batches under way.
constexpr std::uint64_t kLargestBatch = 1 << 20;
}  // namespace

BatchPlan::BatchPlan(std::uint64_t cells, const RunSettings& run) {
    const double jitter = jitter_of(run, cells);
    const double wanted =
        run.rays > 0 ? static_cast<double>(run.rays) : jitter * static_cast<double>(cells);
    if (wanted > static_cast<double>(kMaxRaysPerLayer))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} launch points per cell are {:.3g} rays a layer, more than {}",
                                jitter, wanted, kMaxRaysPerLayer),
                    "jitter");
    rays = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::llround(wanted)));
    batches = std::min<std::uint64_t>(static_cast<std::uint64_t>(run.batches), rays);
    batches = std::max(batches, (rays + kLargestBatch - 1) / kLargestBatch);
    limit = run.max_rays > 0 ? run.max_rays : std::min(kMaxRaysPerLayer, 256 * rays);
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
