// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/tracing/engines/wide/sweep_batch.h>
#include <asperity/tracing/launch.h>

#include <cstdint>

namespace asperity {

/// One batch of light from all around, at an angle onto a periodic surface: sweeps of parallel
/// light, each from an azimuth of its own. The azimuths of a batch are as far from each other all
/// around, and turned together by a random angle: each is uniform, so nothing is biased, and
/// batches are independent.
class SweepsAround {
  public:
    /// Whether light of a batch can come so.
    static bool possible(const Heightfield& surface, const Incidence& incidence,
                         LaunchPattern pattern);
    SweepsAround(const Heightfield& surface, const Incidence& incidence,
                 const BatchRequest& request);

    std::uint64_t sweeps() const { return sweeps_; }
    /// The light of sweep k < sweeps(): of one azimuth.
    Incidence light(std::uint64_t k) const;
    SweepBatch sweep(std::uint64_t k) const;

  private:
    const Heightfield& surface_;
    const Incidence incidence_;
    const BatchRequest request_;
    std::uint64_t sweeps_;
    double turn_;  ///< of the azimuths [turns]
};

}  // namespace asperity
