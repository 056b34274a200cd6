// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/batch_set.h>
#include <asperity/gonio/experiment.h>

#include <algorithm>
#include <cstdint>

namespace asperity {

/// Rays of a batch at most, as BatchSums takes them; and a stopped run loses the batches under way.
inline constexpr std::uint64_t kLargestBatch = 1 << 20;

/// How the rays of a layer are divided into independent batches. Depends on the settings and on
/// the number of cells alone, so every part of a run makes the same plan.
struct BatchPlan {
    /// Throws Error(Usage, "jitter") for more rays than a layer can count, and Error(Usage,
    /// "surfaces") for rays that are too few, or too many, for each of several surfaces.
    BatchPlan(std::uint64_t cells, const RunSettings& run);

    std::uint64_t rays = 0;     ///< of the first round of batches
    std::uint64_t batches = 0;  ///< in the first round
    std::uint64_t limit = 0;    ///< rays of a layer at most
    /// Each batch has a surface of its own, and an even number of rays, the same for all.
    bool of_class = false;

    /// Rays of batch b: all alike, the first ones of a round one more if they must.
    std::uint64_t rays_of(std::uint64_t b) const {
        return rays / batches + (b % batches < rays % batches ? 1 : 0);
    }
    std::uint64_t largest() const { return rays_of(0); }
    /// Rays of the batches before number b.
    std::uint64_t rays_before(std::uint64_t b) const {
        return b / batches * rays + b % batches * (rays / batches) +
               std::min(b % batches, rays % batches);
    }
    /// A layer is looked at when a round of batches is done. The round that ends with the batches
    /// before number `end`, or else the one that they are a part of; the first one for 0. Ends
    /// before `end` if they are more than the limit allows.
    BatchRange round_of(std::uint64_t end) const;
    /// Batches to add to so many, of so many rays, where they were not enough: as many again, or
    /// what the limit leaves room for.
    std::uint64_t more(std::uint64_t so_far, std::uint64_t of_rays) const;

  private:
    void share_out_to(std::uint64_t surfaces);
};

}  // namespace asperity
