// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/batch_sums.h>
#include <asperity/gonio/detector.h>
#include <asperity/gonio/launch.h>
#include <asperity/optics/fresnel.h>
#include <asperity/tracing/engines/wide/wide_tracer.h>

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

/// Direction of travel of parallel light, in the frame of the tracer.
Vec3 direction_of_light(const WideTracer& tracer, const Incidence& light);

/// Follows rays from facet to facet until they leave; the working memory of one thread.
class Follower {
  public:
    /// Portions of a batch that are good to follow at a time: rays that start near each other, some
    /// thousand.
    static std::uint64_t portions(const LaunchBatch& batch);

    /// Follows a portion of a batch, adds what became of its energy to `sums`, and returns how many
    /// rays it held; the last of them may wait for finish(). Adds integers only: the order of the
    /// calls does not matter. A follower that was not asked to finish must not be used for another
    /// batch.
    std::uint64_t follow(const Scene& scene, const LaunchBatch& batch, std::uint64_t portion,
                         BatchSums& sums);
    /// Follows the rays that still wait.
    void finish(const Scene& scene, BatchSums& sums);

  private:
    std::uint64_t follow_lines(const Scene& scene, const LaunchBatch& batch, std::uint64_t portion,
                               BatchSums& sums);
    std::uint64_t follow_rows(const Scene& scene, const LaunchBatch& batch, std::uint64_t portion,
                              BatchSums& sums);
    std::uint64_t follow_each(const Scene& scene, const LaunchBatch& batch, std::uint64_t portion,
                              BatchSums& sums);
    void launch_each(const Scene& scene, const LaunchBatch& batch, std::uint64_t begin,
                     std::uint64_t end);
    void follow_launched(const Scene& scene, BatchSums& sums);
    void follow_wave(const Scene& scene, std::size_t count, bool parallel, BatchSums& sums);
    void reflect(const Scene& scene, bool parallel);
    void settle(const Scene& scene, int reflections, BatchSums& sums);

    PathWave wave_;
    Vec3 direction_;  ///< of parallel light
    std::vector<LaunchRow> rows_;
    LaunchLine line_;
    PerPath<float> cosine_, cos_phi_, sin_phi_;
    PerPath<std::int32_t> cells_;
    std::vector<PerPath<float>> weights_;  ///< [channel], by path; empty for perfect mirrors
    std::vector<PerPath<float>> reflectance_;
    std::vector<Ray> rays_;
};

}  // namespace asperity
