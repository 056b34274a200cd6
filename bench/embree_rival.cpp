// SPDX-License-Identifier: Apache-2.0
// The competitor: Embree in all its modes. A ray that leaves through the side of the scene's margin
// enters again one tile back.
#include "embree_rays.h"
#include "embree_scene.h"
#include "rival.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::bench {

namespace {

/// What the rays of the first segment, parallel and side by side, are said to be.
enum class FirstHit { Incoherent, Coherent };

/// Embree with one kind of geometry and one kind of batch.
template <class Rays>
class EmbreeRival : public Rival {
  public:
    EmbreeRival(std::shared_ptr<const EmbreeScene> scene, std::string geometry, FirstHit first_hit)
        : scene_(std::move(scene)),
          geometry_(std::move(geometry)),
          first_hit_(first_hit),
          lift_(std::max(scene_->tile_x, scene_->tile_y) * 0x1p-21F) {}

    std::string name() const override {
        return geometry_ + Rays::kName + (first_hit_ == FirstHit::Coherent ? "c" : "");
    }
    std::size_t memory_bytes() const override { return scene_->memory_bytes(); }
    double build_seconds() const override { return scene_->build_seconds; }

    Tally run(const Workload& workload) const override {
        Tally tally;
        Rays rays;
        const Vec3 d = workload.direction();
        const float dx = static_cast<float>(workload.surface->dx);
        const float dy = static_cast<float>(workload.surface->dy);
        for (std::size_t first = 0; first < workload.points.size(); first += kBatch) {
            const std::size_t count = std::min(kBatch, workload.points.size() - first);
            for (std::size_t k = 0; k < count; ++k) {
                const StartPoint& at = workload.points[first + k];
                rays.put(
                    k, {(static_cast<float>(at.i) + at.u) * dx,
                        (static_cast<float>(at.j) + at.v) * dy, scene_->top,
                        static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
            }
            follow_batch(rays, count, workload.bounces, tally);
        }
        return tally;
    }

  private:
    /// Reflections and ways through the side of a path; they travel beside it, in the same order.
    struct Counts {
        int bounces = 0, wraps = 0;
    };
    static constexpr int kMaxWraps = 64;

    void follow_batch(Rays& rays, std::size_t alive, int limit, Tally& tally) const {
        std::array<Counts, kBatch> counts{};
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = first_hit_ == FirstHit::Coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                         : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        while (alive > 0) {
            rays.trace(scene_->handle(), &context, alive);
            tally.add_segments(alive);
            std::size_t kept = 0;
            for (std::size_t k = 0; k < alive; ++k) {
                EmbreePath path = rays.get(k);
                Counts count = counts[k];
                if (!advance(path, rays.found(k), count, limit, tally)) continue;
                counts[kept] = count;
                rays.put(kept++, path);
            }
            alive = kept;
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        }
    }

    /// Takes a path on from what Embree found; false when it has ended.
    bool advance(EmbreePath& p, const EmbreeFound& found, Counts& count, int limit,
                 Tally& tally) const {
        if (!found.hit) return leave(p, count, tally);
        if (count.bounces == limit) {
            tally.add_truncated(1, static_cast<std::uint64_t>(count.bounces));
            return false;
        }
        const float length =
            std::sqrt(found.nx * found.nx + found.ny * found.ny + found.nz * found.nz);
        const float up = found.nz < 0 ? -1 / length : 1 / length;
        const float nx = found.nx * up, ny = found.ny * up, nz = found.nz * up;
        const float along = p.dx * nx + p.dy * ny + p.dz * nz;
        if (along >= 0) {  // from below: it had slipped through
            tally.add_lost();
            return false;
        }
        p = {p.x + found.t * p.dx + lift_ * nx,
             p.y + found.t * p.dy + lift_ * ny,
             p.z + found.t * p.dz + lift_ * nz,
             p.dx - 2 * along * nx,
             p.dy - 2 * along * ny,
             p.dz - 2 * along * nz};
        ++count.bounces;
        return true;
    }

    /// A path that meets no triangle any more: out through the top, or through the side and on.
    bool leave(EmbreePath& p, Counts& count, Tally& tally) const {
        const float to_top = p.dz > 0 ? std::max(0.0F, (scene_->top - p.z) / p.dz) : kInfinity;
        const float to_x = side(p.x, p.dx, scene_->tile_x, scene_->margin_x);
        const float to_y = side(p.y, p.dy, scene_->tile_y, scene_->margin_y);
        const float to_side = std::min(to_x, to_y);
        if (to_top <= to_side && to_top < kInfinity) {
            tally.add_escape(cells_, p.dx, p.dy, count.bounces);
            return false;
        }
        if (!(to_side < kInfinity) || count.wraps == kMaxWraps) {
            tally.add_lost();
            return false;
        }
        p.x += to_side * p.dx, p.y += to_side * p.dy, p.z += to_side * p.dz;
        if (to_x <= to_y) p.x -= std::copysign(scene_->tile_x, p.dx);
        if (to_y <= to_x) p.y -= std::copysign(scene_->tile_y, p.dy);
        ++count.wraps;
        return true;
    }

    /// Distance along one axis to the end of the margin.
    static float side(float x, float d, float tile, float margin) {
        if (d > 0) return std::max(0.0F, (tile + margin - x) / d);
        if (d < 0) return std::max(0.0F, (-margin - x) / d);
        return kInfinity;
    }

    std::shared_ptr<const EmbreeScene> scene_;
    std::string geometry_;
    FirstHit first_hit_;
    DirectionCells cells_;
    float lift_;  ///< start of a reflected ray above its facet, so that it does not meet it again
};

/// Adds the modes of one geometry to a list.
class Modes {
  public:
    Modes(const Heightfield& surface, EmbreeGeometry geometry,
          std::vector<std::unique_ptr<Rival>>& rivals)
        : scene(std::make_shared<const EmbreeScene>(surface, geometry)),
          name_(geometry == EmbreeGeometry::Grid ? "grid" : "tri"),
          rivals_(rivals) {}

    template <class Rays>
    void add(FirstHit first_hit) {
        rivals_.push_back(std::make_unique<EmbreeRival<Rays>>(scene, name_, first_hit));
    }
    template <class Rays>
    void add_both() {
        add<Rays>(FirstHit::Incoherent);
        add<Rays>(FirstHit::Coherent);
    }
    void add_all() {
        add<SingleRays<false>>(FirstHit::Incoherent);  // a single ray takes no notice of the flag
        add_both<PacketRays<4>>();
        add_both<PacketRays<8>>();
        add_both<PacketRays<16>>();
        if (!scene->has(RTC_DEVICE_PROPERTY_RAY_STREAM_SUPPORTED)) return;
        add_both<SingleRays<true>>();
        add_both<PacketRays<8, true>>();
        add_both<ArrayRays>();
    }

    const std::shared_ptr<const EmbreeScene> scene;

  private:
    std::string name_;
    std::vector<std::unique_ptr<Rival>>& rivals_;
};

}  // namespace

std::vector<std::unique_ptr<Rival>> make_embree_rivals(const Heightfield& surface,
                                                       EmbreeModes modes) {
    std::vector<std::unique_ptr<Rival>> rivals;
    if (modes == EmbreeModes::None) return rivals;
    if (modes != EmbreeModes::Grid) {
        Modes triangles(surface, EmbreeGeometry::Triangles, rivals);
        if (modes == EmbreeModes::All) {
            triangles.add_all();
        } else {
            triangles.add<PacketRays<4>>(FirstHit::Incoherent);
            triangles.add_both<PacketRays<8>>();
            triangles.add<PacketRays<8, true>>(FirstHit::Incoherent);
            if (triangles.scene->has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) {
                triangles.add_both<PacketRays<16>>();
            }
        }
    }
    Modes grid(surface, EmbreeGeometry::Grid, rivals);
    if (modes == EmbreeModes::All) {
        grid.add_all();
    } else {
        grid.add_both<PacketRays<8>>();
    }
    return rivals;
}

}  // namespace asperity::bench
