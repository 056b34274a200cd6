// SPDX-License-Identifier: Apache-2.0
// The competitor. Embree knows no periodic surface: it gets one tile with a margin of its
// neighbours around it, and a ray that leaves through the side of that enters again one tile back.
#include "rival.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace asperity::bench {

namespace {

constexpr int kMargin = 64;  // cells; keeps ways through the side rare
constexpr float kInfinity = std::numeric_limits<float>::infinity();

enum class Geometry { Triangles, Grid };

/// Embree counts what it takes and gives back.
bool count_bytes(void* total, ssize_t bytes, bool) {
    static_cast<std::atomic<std::ptrdiff_t>*>(total)->fetch_add(bytes);
    return true;
}

/// One tile and its margin as an Embree scene.
class Scene {
  public:
    Scene(const Heightfield& surface, Geometry geometry)
        : tile_x(static_cast<float>(surface.nx * surface.dx)),
          tile_y(static_cast<float>(surface.ny * surface.dy)),
          margin_cells_(std::min({kMargin, surface.nx, surface.ny})),
          surface_(surface),
          device_(rtcNewDevice(nullptr)) {
        if (device_ == nullptr) throw std::runtime_error("Embree gives no device");
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
        margin_x = static_cast<float>(margin_cells_ * surface.dx);
        margin_y = static_cast<float>(margin_cells_ * surface.dy);
        top = *std::max_element(surface.heights.begin(), surface.heights.end());
        const auto begin = std::chrono::steady_clock::now();
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        const RTCGeometry mesh = geometry == Geometry::Grid ? new_grid() : new_triangles();
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene_);
        build_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
            throw std::runtime_error("Embree could not build the scene");
        }
    }
    ~Scene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    RTCScene handle() const { return scene_; }
    std::size_t memory_bytes() const { return static_cast<std::size_t>(bytes_.load()); }
    bool has_wide_registers() const {
        return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    }

    float tile_x, tile_y, margin_x = 0, margin_y = 0;
    float top = 0;  ///< the highest point
    double build_seconds = 0;

  private:
    unsigned columns() const { return static_cast<unsigned>(surface_.nx + 2 * margin_cells_ + 1); }
    unsigned rows() const { return static_cast<unsigned>(surface_.ny + 2 * margin_cells_ + 1); }

    void add_vertices(RTCGeometry mesh) const {
        auto* vertex = static_cast<float*>(
            rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), std::size_t{columns()} * rows()));
        for (unsigned row = 0; row < rows(); ++row) {
            const int j = static_cast<int>(row) - margin_cells_;
            for (unsigned column = 0; column < columns(); ++column) {
                const int i = static_cast<int>(column) - margin_cells_;
                *vertex++ = static_cast<float>(i * surface_.dx);
                *vertex++ = static_cast<float>(j * surface_.dy);
                *vertex++ =
                    surface_.at((i + surface_.nx) % surface_.nx, (j + surface_.ny) % surface_.ny);
            }
        }
    }

    RTCGeometry new_triangles() const {
        const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        add_vertices(mesh);
        const std::size_t cells = std::size_t{columns() - 1} * (rows() - 1);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * cells));
        for (unsigned row = 0; row + 1 < rows(); ++row) {
            for (unsigned column = 0; column + 1 < columns(); ++column) {
                const unsigned a = row * columns() + column, b = a + 1;
                const unsigned c = a + columns(), d = c + 1;
                for (const unsigned corner : {a, b, c, b, d, c}) *index++ = corner;
            }
        }
        return mesh;
    }

    RTCGeometry new_grid() const {
        const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
        add_vertices(mesh);
        auto* grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
        *grid = {0, columns(), static_cast<unsigned short>(columns()),
                 static_cast<unsigned short>(rows())};
        return mesh;
    }

    int margin_cells_;
    const Heightfield& surface_;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
    std::atomic<std::ptrdiff_t> bytes_{0};
};

/// Embree's packet of `kLanes` rays, and the call that traces it.
template <int kLanes>
struct Packet;
template <>
struct Packet<8> {
    using Type = RTCRayHit8;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, Type* p) {
        rtcIntersect8(valid, scene, context, p);
    }
};
template <>
struct Packet<16> {
    using Type = RTCRayHit16;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, Type* p) {
        rtcIntersect16(valid, scene, context, p);
    }
};

/// A path between two calls of Embree.
struct Path {
    float x, y, z, dx, dy, dz;
};
/// What Embree found for it.
struct Found {
    bool hit;
    float t, nx, ny, nz;  ///< distance; normal, not unit length
};

/// A batch of single rays.
class SingleRays {
  public:
    static constexpr const char* kName = "1";
    SingleRays() : rays_(kBatch) {}

    void put(std::size_t k, const Path& p) {
        RTCRay& r = rays_[k].ray;
        r.org_x = p.x, r.org_y = p.y, r.org_z = p.z;
        r.dir_x = p.dx, r.dir_y = p.dy, r.dir_z = p.dz;
    }
    Path get(std::size_t k) const {
        const RTCRay& r = rays_[k].ray;
        return {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z};
    }
    Found found(std::size_t k) const {
        const RTCRayHit& r = rays_[k];
        return {r.hit.geomID != RTC_INVALID_GEOMETRY_ID, r.ray.tfar, r.hit.Ng_x, r.hit.Ng_y,
                r.hit.Ng_z};
    }
    void trace(RTCScene scene, RTCIntersectContext* context, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            RTCRayHit& r = rays_[k];
            r.ray.tnear = 0, r.ray.time = 0, r.ray.tfar = kInfinity;
            r.ray.mask = ~0U, r.ray.flags = 0;
            r.hit.geomID = RTC_INVALID_GEOMETRY_ID, r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, context, &r);
        }
    }

  private:
    std::vector<RTCRayHit> rays_;
};

/// A batch in packets of kLanes rays, kept in Embree's own layout.
template <int kLanes>
class PacketRays {
  public:
    static constexpr const char* kName = kLanes == 8 ? "8" : "16";
    PacketRays() : packets_(kBatch / kLanes) {}

    void put(std::size_t k, const Path& p) {
        auto& r = packets_[k / kLanes].ray;
        const std::size_t lane = k % kLanes;
        r.org_x[lane] = p.x, r.org_y[lane] = p.y, r.org_z[lane] = p.z;
        r.dir_x[lane] = p.dx, r.dir_y[lane] = p.dy, r.dir_z[lane] = p.dz;
    }
    Path get(std::size_t k) const {
        const auto& r = packets_[k / kLanes].ray;
        const std::size_t lane = k % kLanes;
        return {r.org_x[lane], r.org_y[lane], r.org_z[lane],
                r.dir_x[lane], r.dir_y[lane], r.dir_z[lane]};
    }
    Found found(std::size_t k) const {
        const auto& p = packets_[k / kLanes];
        const std::size_t lane = k % kLanes;
        return {p.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID, p.ray.tfar[lane], p.hit.Ng_x[lane],
                p.hit.Ng_y[lane], p.hit.Ng_z[lane]};
    }
    void trace(RTCScene scene, RTCIntersectContext* context, std::size_t count) {
        for (std::size_t first = 0; first < count; first += kLanes) {
            auto& p = packets_[first / kLanes];
            alignas(64) int valid[kLanes];
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                valid[lane] = first + lane < count ? -1 : 0;
                p.ray.tnear[lane] = 0, p.ray.time[lane] = 0, p.ray.tfar[lane] = kInfinity;
                p.ray.mask[lane] = ~0U, p.ray.flags[lane] = 0;
                p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
                p.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
            }
            Packet<kLanes>::intersect(valid, scene, context, &p);
        }
    }

  private:
    std::vector<typename Packet<kLanes>::Type> packets_;
};

/// Embree with one kind of geometry and one kind of batch.
template <class Rays>
class EmbreeRival : public Rival {
  public:
    EmbreeRival(std::shared_ptr<const Scene> scene, std::string geometry)
        : scene_(std::move(scene)),
          geometry_(std::move(geometry)),
          lift_(std::max(scene_->tile_x, scene_->tile_y) * 0x1p-21F) {}

    std::string name() const override { return "embree_" + geometry_ + Rays::kName; }
    std::size_t memory_bytes() const override { return scene_->memory_bytes(); }
    double build_seconds() const override { return scene_->build_seconds; }

    Tally follow(const Workload& workload) const override {
        Tally tally;
        Rays rays;
        const Vec3 d = workload.direction;
        const float dx = static_cast<float>(workload.surface->dx);
        const float dy = static_cast<float>(workload.surface->dy);
        for (std::size_t first = 0; first < workload.launch.size(); first += kBatch) {
            const std::size_t count = std::min(kBatch, workload.launch.size() - first);
            for (std::size_t k = 0; k < count; ++k) {
                const Launch& at = workload.launch[first + k];
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
    /// `bounces` and `turns` of a path travel beside it, in the same order.
    struct Counts {
        int bounces = 0, wraps = 0;
    };
    static constexpr int kMaxWraps = 64;

    void follow_batch(Rays& rays, std::size_t alive, int limit, Tally& tally) const {
        std::array<Counts, kBatch> counts{};
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;  // parallel rays, side by side
        while (alive > 0) {
            rays.trace(scene_->handle(), &context, alive);
            tally.add_segments(alive);
            std::size_t kept = 0;
            for (std::size_t k = 0; k < alive; ++k) {
                Path path = rays.get(k);
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
    bool advance(Path& p, const Found& found, Counts& count, int limit, Tally& tally) const {
        if (!found.hit) return leave(p, count, tally);
        if (count.bounces == limit) {
            tally.add_truncated();
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
    bool leave(Path& p, Counts& count, Tally& tally) const {
        const float to_top = p.dz > 0 ? std::max(0.0F, (scene_->top - p.z) / p.dz) : kInfinity;
        const float to_x = side(p.x, p.dx, scene_->tile_x, scene_->margin_x);
        const float to_y = side(p.y, p.dy, scene_->tile_y, scene_->margin_y);
        const float to_side = std::min(to_x, to_y);
        if (to_top <= to_side && to_top < kInfinity) {
            tally.add_escape(static_cast<double>(p.dx), static_cast<double>(p.dy), count.bounces);
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

    std::shared_ptr<const Scene> scene_;
    std::string geometry_;
    float lift_;  ///< start of a reflected ray above its facet, so that it does not meet it again
};

}  // namespace

std::vector<std::unique_ptr<Rival>> make_embree_rivals(const Heightfield& surface) {
    const auto triangles = std::make_shared<const Scene>(surface, Geometry::Triangles);
    const auto grid = std::make_shared<const Scene>(surface, Geometry::Grid);
    std::vector<std::unique_ptr<Rival>> rivals;
    rivals.push_back(std::make_unique<EmbreeRival<SingleRays>>(triangles, "tri"));
    rivals.push_back(std::make_unique<EmbreeRival<PacketRays<8>>>(triangles, "tri"));
    if (triangles->has_wide_registers()) {
        rivals.push_back(std::make_unique<EmbreeRival<PacketRays<16>>>(triangles, "tri"));
    }
    rivals.push_back(std::make_unique<EmbreeRival<PacketRays<8>>>(grid, "grid"));
    return rivals;
}

}  // namespace asperity::bench
