// SPDX-License-Identifier: Apache-2.0
#include "clocks.h"
#include "rival.h"

#include <asperity/tracing/engines/plain/tracer.h>

#include <algorithm>
#include <span>

namespace asperity::bench {

namespace {

class PlainRival : public Rival {
  public:
    PlainRival(const Heightfield& surface, int threads)
        : begin_(wall_seconds()),
          tracer_(surface, threads),
          build_seconds_(wall_seconds() - begin_) {}

    std::string name() const override { return "plain"; }
    std::size_t memory_bytes() const override { return tracer_.memory_bytes(); }
    double build_seconds() const override { return build_seconds_; }

    Tally run(const Workload& workload) const override {
        Tally tally;
        std::vector<Ray> rays(kBatch);
        std::vector<RayEnd> ends(kBatch);
        const Vec3 direction = workload.direction();
        for (std::size_t first = 0; first < workload.points.size(); first += kBatch) {
            const std::size_t count = std::min(kBatch, workload.points.size() - first);
            for (std::size_t k = 0; k < count; ++k) {
                const StartPoint& at = workload.points[first + k];
                rays[k] = {at.i,
                           at.j,
                           static_cast<double>(at.u),
                           static_cast<double>(at.v),
                           static_cast<double>(tracer_.max_height()),
                           direction,
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
                    tally.add_escape(cells_, static_cast<float>(ray.direction.x),
                                     static_cast<float>(ray.direction.y), bounces);
                } else if (ends[k] != RayEnd::Hit) {
                    tally.add_lost();
                } else if (bounces == limit) {
                    tally.add_truncated(1, static_cast<std::uint64_t>(bounces));
                } else {
                    const Vec3 n = tracer_.normal(ray);
                    ray.direction = ray.direction - 2 * dot(ray.direction, n) * n;
                    rays[kept++] = ray;
                }
            }
            alive = kept;
        }
    }

    DirectionCells cells_;
    double begin_;
    Tracer tracer_;
    double build_seconds_;
};

}  // namespace

std::unique_ptr<Rival> make_plain_rival(const Heightfield& surface, int threads) {
    return std::make_unique<PlainRival>(surface, threads);
}

}  // namespace asperity::bench
