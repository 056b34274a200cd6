// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/detector/batch_sums.h>
#include <asperity/detector/detector.h>
#include <asperity/optics/fresnel.h>
#include <asperity/tracing/engines/wide/path_kernels.h>
#include <asperity/tracing/engines/wide/sweeps_around.h>
#include <asperity/tracing/engines/wide/wide_tracer.h>
#include <asperity/tracing/launch.h>

#include <cstdint>
#include <vector>

namespace asperity {

class KnownFacets;

/// What the rays of a layer have in common on their way.
struct Scene {
    const Heightfield& surface;
    const WideTracer& tracer;
    const Fresnel& fresnel;
    const Detector& detector;
    int bounces = 1;  ///< Ray Bounces B
    Incidence light;
    const KnownFacets* known = nullptr;  ///< of this light; may be null
};

/// Direction of travel of parallel light, in the frame of the tracer.
Vec3 direction_of_light(const WideTracer& tracer, const Incidence& light);

/// Follows rays from facet to facet until they leave; the working memory of one thread.
class Follower {
  public:
    /// LitSurface::trace.
    bool follow(const Scene& scene, const BatchRequest& request, BatchSums& sums, Run& run);

  private:
    bool follow_around(const Scene& scene, const SweepsAround& batch, BatchSums& sums, Run& run);
    bool follow_lines(const Scene& scene, const SweepBatch& batch, BatchSums& sums, Run& run);
    bool follow_rows(const Scene& scene, const LaunchBatch& batch, BatchSums& sums, Run& run);
    bool follow_each(const Scene& scene, const LaunchBatch& batch, BatchSums& sums, Run& run);
    std::uint64_t launch_stripe(const Scene& scene, LaunchStripe stripe, BatchSums& sums);
    std::uint64_t launch_rows(const Scene& scene, const LaunchBatch& batch, std::uint64_t first,
                              BatchSums& sums);
    void launch_each(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                     std::uint64_t end);
    void finish(const Scene& scene, BatchSums& sums);
    void follow_launched(const Scene& scene, BatchSums& sums);
    void follow_wave(const Scene& scene, std::size_t count, bool parallel, BatchSums& sums);
    void reflect(const Scene& scene, bool parallel);
    void settle(const Scene& scene, int reflections, BatchSums& sums);

    PathWave wave_;
    std::uint64_t counted_ = 0;  ///< rays of the batch onto known facets
    Vec3 direction_;             ///< of parallel light
    Turn turn_;                  ///< of the azimuths it is sorted by
    std::vector<LaunchRow> rows_;
    LaunchLine line_;
    PerPath<float> cosine_, cos_phi_, sin_phi_;
    PerPath<std::int32_t> cells_;
    std::vector<PerPath<float>> weights_;  ///< [channel], by path; empty for perfect mirrors
    std::vector<PerPath<float>> reflectance_;
    std::vector<const float*> weights_of_;  ///< the same weights, as BatchSums wants them
    std::vector<Ray> rays_;
};

}  // namespace asperity
