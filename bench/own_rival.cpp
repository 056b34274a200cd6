// SPDX-License-Identifier: Apache-2.0
#include "rival.h"

#include <asperity/tracing/tracer.h>

#include <algorithm>
#include <chrono>
#include <span>

namespace asperity::bench {

namespace {

using Clock = std::chrono::steady_clock;

class OwnRival : public Rival {
  public:
    OwnRival(const Heightfield& surface, int threads)
        : begin_(Clock::now()),
          tracer_(surface, threads),
          build_seconds_(std::chrono::duration<double>(Clock::now() - begin_).count()) {}

    std::string name() const override { return "asperity"; }
    std::size_t memory_bytes() const override { return tracer_.memory_bytes(); }
    double build_seconds() const override { return build_seconds_; }

    Tally follow(const Workload& workload) const override {
        Tally tally;
        std::vector<Ray> rays(kBatch);
        std::vector<RayEnd> ends(kBatch);
        for (std::size_t first = 0; first < workload.launch.size(); first += kBatch) {
            const std::size_t count = std::min(kBatch, workload.launch.size() - first);
            for (std::size_t k = 0; k < count; ++k) {
                const Launch& at = workload.launch[first + k];
                rays[k] = {at.i,
                           at.j,
                           static_cast<double>(at.u),
                           static_cast<double>(at.v),
                           static_cast<double>(tracer_.max_height()),
                           workload.direction,
                           -1};
            }
            follow_batch(rays, ends, count, workload.bounces, tally);
        }
        return tally;
    }

  private:
    void follow_batch(std::span<Ray> rays, std::span<RayEnd> ends, std::size_t alive, int limit,
                      Tally& tally) const {
        for (int bounces = 0; alive > 0; ++bounces) {
            tracer_.trace(rays.first(alive), ends.first(alive));
            tally.add_segments(alive);
            std::size_t kept = 0;
            for (std::size_t k = 0; k < alive; ++k) {
                Ray& ray = rays[k];
                if (ends[k] == RayEnd::Escaped) {
                    tally.add_escape(ray.direction.x, ray.direction.y, bounces);
                } else if (ends[k] != RayEnd::Hit) {
                    tally.add_lost();
                } else if (bounces == limit) {
                    tally.add_truncated();
                } else {
                    const Vec3 n = tracer_.normal(ray);
                    ray.direction = ray.direction - 2 * dot(ray.direction, n) * n;
                    rays[kept++] = ray;
                }
            }
            alive = kept;
        }
    }

    Clock::time_point begin_;
    Tracer tracer_;
    double build_seconds_;
};

}  // namespace

std::unique_ptr<Rival> make_own_rival(const Heightfield& surface, int threads) {
    return std::make_unique<OwnRival>(surface, threads);
}

}  // namespace asperity::bench
