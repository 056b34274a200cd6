// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/batch_sums.h>
#include <asperity/gonio/detector.h>
#include <asperity/gonio/launch.h>
#include <asperity/optics/fresnel.h>
#include <asperity/tracing/wide_tracer.h>

#include <cstdint>
#include <vector>

namespace asperity {

class KnownFacets;

/// What the rays of a layer have in common on their way.
struct Scene {
    const WideTracer& tracer;
    const Fresnel& fresnel;
    const Detector& detector;
    int bounces = 1;                     ///< Ray Bounces B
    bool relative_azimuth = false;       ///< sort by the azimuth relative to the light's
    const KnownFacets* known = nullptr;  ///< of this light; may be null
};

/// Gives paths 0 .. count - 1 the direction of the light, all the same one: arriving()[0]. Returns
/// it in the frame of the tracer.
Vec3 set_parallel(const WideTracer& tracer, const Incidence& light, std::size_t count,
                  PathWave& wave);

/// Follows rays from facet to facet until they leave; the working memory of one thread.
class Follower {
  public:
    /// Rays followed at a time.
    static constexpr std::uint64_t kMost = kWave;

    /// Follows the rays [begin, end) of a batch, at most kMost, and adds what became of their
    /// energy to `sums`. Adds integers only: the order of the calls does not matter.
    void follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                std::uint64_t end, BatchSums& sums);

  private:
    void launch(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                std::uint64_t end);
    void launch_rows(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                     std::uint64_t end);
    void launch_each(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                     std::uint64_t end);
    void settle_known(const Scene& scene, BatchSums& sums);
    void reflect(const Scene& scene, bool parallel);
    void settle(const Scene& scene, int reflections, BatchSums& sums);

    PathWave wave_;
    LaunchLine line_;
    PerPath<float> cosine_, cos_phi_, sin_phi_;
    PerPath<std::int32_t> cells_, paths_;
    std::vector<PerPath<float>> weights_;  ///< [channel], by path; empty for perfect mirrors
    std::vector<PerPath<float>> reflectance_;
    std::vector<Ray> rays_;
    bool in_rows_ = false;
};

}  // namespace asperity
