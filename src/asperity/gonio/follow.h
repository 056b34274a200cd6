// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/batch_sums.h>
#include <asperity/gonio/detector.h>
#include <asperity/gonio/launch.h>
#include <asperity/optics/fresnel.h>
#include <asperity/tracing/tracer.h>

#include <cstdint>

namespace asperity {

/// What the rays of a layer have in common on their way.
struct Scene {
    const Tracer& tracer;
    const Fresnel& fresnel;
    const Detector& detector;
    int bounces = 1;                ///< Ray Bounces B
    bool relative_azimuth = false;  ///< sort by the azimuth relative to the light's
};

/// Follows the rays [begin, end) of a batch from facet to facet until they leave, and adds what
/// became of their energy to `sums`. Adds integers only: the order of the calls does not matter.
void follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin, std::uint64_t end,
            BatchSums& sums);

}  // namespace asperity
