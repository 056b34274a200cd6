// SPDX-License-Identifier: Apache-2.0
// Primary and shadow rays per second beside loops that do nothing but call Embree: a ray from the
// camera through each pixel, and from where it ends one to the lamp.
#include "averages.h"
#include "clocks.h"
#include "render_scenes.h"
#include "render_tasks.h"
#include "task_options.h"

#include <asperity/bsdf/models/lambert.h>
#include <asperity/render/shading.h>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <pmmintrin.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

namespace asperity::bench {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr int kTile = 16;

struct RenderRaysOptions {
    int size = 512;
    int repetitions = 9;
};

/// How many rays were traced, and how long that took.
struct Rate {
    std::uint64_t primary = 0, shadow = 0, lit = 0;
    double seconds = 0;
    double per_second() const { return static_cast<double>(primary + shadow) / seconds; }
};

/// The world of a model in one Embree scene.
class BareScene {
  public:
    explicit BareScene(const Model& model) : device_(rtcNewDevice(nullptr)) {
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (const Instance& instance : model.instances) add(model.meshes[instance.mesh], instance);
        rtcCommitScene(scene_);
    }
    ~BareScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareScene(const BareScene&) = delete;
    BareScene& operator=(const BareScene&) = delete;
    RTCScene handle() const { return scene_; }

  private:
    void add(const TriangleMesh& mesh, const Instance& instance) {
        const RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                              mesh.positions.size()));
        for (const Vec3f v : mesh.positions) {
            const Vec3 w = instance.to_world.point(to_double(v));
            *p++ = static_cast<float>(w.x);
            *p++ = static_cast<float>(w.y);
            *p++ = static_cast<float>(w.z);
        }
        auto* t = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), mesh.triangles.size()));
        for (const auto& triangle : mesh.triangles)
            t = std::copy(triangle.begin(), triangle.end(), t);
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
    }

    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

Vec3f single(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A camera in single precision.
struct BareCamera {
    Vec3f origin, corner, right, down;

    BareCamera(const Camera& camera, int size) {
        const double pixel = 2 * std::tan(0.5 * radians(camera.fov_deg)) / size;
        origin = single(camera.position);
        right = single(pixel * camera.right());
        down = single(-pixel * camera.up);
        const double half = 0.5 * pixel * (size - 1);
        corner = single(camera.forward - half * camera.right() + half * camera.up);
    }
};

/// Packets of 8 rays, 8 pixels side by side, tile by tile.
Rate bare_packets(const BareScene& scene, const BareCamera& c, int size) {
    Rate rate;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const Vec3f lamp = single(kBenchLamp.position);
    const double begin = cpu_seconds();
    for (int tile_y = 0; tile_y < size; tile_y += kTile)
        for (int tile_x = 0; tile_x < size; tile_x += kTile)
            for (int k = 0; k < kTile * kTile / 8; ++k) {
                const int y = tile_y + k / 2, x = tile_x + 8 * (k % 2);
                RTCRayHit8 r;
                alignas(32) int valid[8];
                for (int lane = 0; lane < 8; ++lane) {
                    const float i = static_cast<float>(x + lane), j = static_cast<float>(y);
                    valid[lane] = -1;
                    r.ray.org_x[lane] = c.origin.x;
                    r.ray.org_y[lane] = c.origin.y;
                    r.ray.org_z[lane] = c.origin.z;
                    r.ray.dir_x[lane] = c.corner.x + i * c.right.x + j * c.down.x;
                    r.ray.dir_y[lane] = c.corner.y + i * c.right.y + j * c.down.y;
                    r.ray.dir_z[lane] = c.corner.z + i * c.right.z + j * c.down.z;
                    r.ray.tnear[lane] = 0, r.ray.tfar[lane] = kFar, r.ray.time[lane] = 0;
                    r.ray.mask[lane] = ~0u, r.ray.flags[lane] = 0;
                    r.hit.geomID[lane] = r.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
                }
                rtcIntersect8(valid, scene.handle(), &context, &r);
                rate.primary += 8;
                RTCRay8 s;
                int hits = 0;
                for (int lane = 0; lane < 8; ++lane) {
                    const bool hit = r.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
                    valid[lane] = hit ? -1 : 0;
                    hits += hit ? 1 : 0;
                    const float t = hit ? 0.9999f * r.ray.tfar[lane] : 0;
                    s.org_x[lane] = r.ray.org_x[lane] + t * r.ray.dir_x[lane];
                    s.org_y[lane] = r.ray.org_y[lane] + t * r.ray.dir_y[lane];
                    s.org_z[lane] = r.ray.org_z[lane] + t * r.ray.dir_z[lane];
                    s.dir_x[lane] = lamp.x - s.org_x[lane];
                    s.dir_y[lane] = lamp.y - s.org_y[lane];
                    s.dir_z[lane] = lamp.z - s.org_z[lane];
                    const float facing = s.dir_x[lane] * r.hit.Ng_x[lane] +
                                         s.dir_y[lane] * r.hit.Ng_y[lane] +
                                         s.dir_z[lane] * r.hit.Ng_z[lane];
                    if (hit && facing <= 0) valid[lane] = 0, --hits;
                    s.tnear[lane] = 0, s.tfar[lane] = 1, s.time[lane] = 0;
                    s.mask[lane] = ~0u, s.flags[lane] = 0;
                }
                if (hits == 0) continue;
                rtcOccluded8(valid, scene.handle(), &context, &s);
                for (int lane = 0; lane < 8; ++lane) {
                    if (valid[lane] == 0) continue;
                    ++rate.shadow;
                    rate.lit += s.tfar[lane] >= 0 ? 1 : 0;
                }
            }
    rate.seconds = cpu_seconds() - begin;
    return rate;
}

/// The same, ray by ray.
Rate bare_singles(const BareScene& scene, const BareCamera& c, int size) {
    Rate rate;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const Vec3f lamp = single(kBenchLamp.position);
    const double begin = cpu_seconds();
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float i = static_cast<float>(x), j = static_cast<float>(y);
            RTCRayHit r;
            r.ray.org_x = c.origin.x, r.ray.org_y = c.origin.y, r.ray.org_z = c.origin.z;
            r.ray.dir_x = c.corner.x + i * c.right.x + j * c.down.x;
            r.ray.dir_y = c.corner.y + i * c.right.y + j * c.down.y;
            r.ray.dir_z = c.corner.z + i * c.right.z + j * c.down.z;
            r.ray.tnear = 0, r.ray.tfar = kFar, r.ray.time = 0, r.ray.mask = ~0u, r.ray.flags = 0;
            r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene.handle(), &context, &r);
            ++rate.primary;
            if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            RTCRay s;
            const float t = 0.9999f * r.ray.tfar;
            s.org_x = r.ray.org_x + t * r.ray.dir_x;
            s.org_y = r.ray.org_y + t * r.ray.dir_y;
            s.org_z = r.ray.org_z + t * r.ray.dir_z;
            s.dir_x = lamp.x - s.org_x, s.dir_y = lamp.y - s.org_y, s.dir_z = lamp.z - s.org_z;
            if (s.dir_x * r.hit.Ng_x + s.dir_y * r.hit.Ng_y + s.dir_z * r.hit.Ng_z <= 0) continue;
            s.tnear = 0, s.tfar = 1, s.time = 0, s.mask = ~0u, s.flags = 0;
            rtcOccluded1(scene.handle(), &context, &s);
            ++rate.shadow;
            rate.lit += s.tfar >= 0 ? 1 : 0;
        }
    rate.seconds = cpu_seconds() - begin;
    return rate;
}

/// What the renderer does for the same rays: rays in double precision, tile by tile, the surface
/// where they end, and rays to the lamp, without shading.
Rate our_rays(const RenderBench& bench, int size) {
    Rate rate;
    const TracedModel& model = *bench.traced;
    const PixelRays pixels(bench.camera, size, size);
    std::vector<WorldRay> rays(kTile * kTile), shadows;
    std::vector<Hit> hits(rays.size());
    std::vector<double> distances;
    std::vector<std::uint8_t> hidden;
    const double begin = cpu_seconds();
    for (int y = 0; y < size; y += kTile)
        for (int x = 0; x < size; x += kTile) {
            for (std::size_t k = 0; k < rays.size(); ++k) {
                const int i = static_cast<int>(k) % kTile, j = static_cast<int>(k) / kTile;
                rays[k] = pixels.at(x + i + 0.5, y + j + 0.5);
            }
            model.intersect(rays, hits);
            rate.primary += rays.size();
            shadows.clear();
            distances.clear();
            for (std::size_t k = 0; k < rays.size(); ++k) {
                if (!hits[k].found()) continue;
                const SurfacePoint p = model.surface(rays[k], hits[k]);
                const Vec3 to_lamp = kBenchLamp.position - p.position;
                if (!lit_from(p, to_lamp)) continue;
                const double distance = length(to_lamp);
                shadows.push_back(
                    {p.position + p.offset * p.geometric_normal, (1 / distance) * to_lamp});
                distances.push_back(distance);
            }
            hidden.resize(shadows.size());
            model.occluded(shadows, distances, hidden);
            rate.shadow += shadows.size();
            for (const std::uint8_t h : hidden) rate.lit += 1u - h;
        }
    rate.seconds = cpu_seconds() - begin;
    return rate;
}

/// A whole frame: samples, shading and film too.
Rate our_frame(const RenderBench& bench, int size) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.depth = 1;
    settings.filter = PixelFilter::Centre;
    const Material matt(std::make_shared<LambertBrdf>(std::vector<double>{0.5}));
    RayCounts counts;
    Rate rate;
    rate.seconds = frame_seconds(bench.scene(matt, false), bench.camera, settings, 1, &counts);
    rate.primary = counts.primary;
    rate.shadow = counts.shadow;
    return rate;
}

Report run_render_rays(const RenderRaysOptions& options) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    Report report;
    report.table = fmt::format(
        "Primary and shadow rays, {0} x {0}, one lamp, one thread: millions per second\n"
        "{1:<10}{2:>12}{3:>10}{4:>10}{5:>10}{6:>12}{7:>12}\n",
        options.size, "model", "bare 1", "bare 8", "ours", "frame", "ours/bare", "frame/bare");
    for (const char* name : {"sphere", "knot", "ball", "bowl"}) {
        say_next(name);
        const RenderBench bench(name);
        const BareScene bare(bench.model);
        const BareCamera camera(bench.camera, options.size);
        std::vector<double> one, eight, ours, frame, ours_ratio, frame_ratio;
        Rate a, b;
        for (int k = 0; k < options.repetitions; ++k) {
            one.push_back(bare_singles(bare, camera, options.size).per_second());
            eight.push_back((a = bare_packets(bare, camera, options.size)).per_second());
            ours.push_back((b = our_rays(bench, options.size)).per_second());
            frame.push_back(our_frame(bench, options.size).per_second());
            const double best = std::max(one.back(), eight.back());
            ours_ratio.push_back(ours.back() / best);
            frame_ratio.push_back(frame.back() / best);
        }
        // Both must have done the same
        const auto differ = [](std::uint64_t x, std::uint64_t y) {
            return std::abs(static_cast<double>(x) - static_cast<double>(y)) >
                   0.01 * static_cast<double>(y);
        };
        if (differ(a.shadow, b.shadow) || differ(a.lit, b.lit))
            throw std::runtime_error(fmt::format("{}: {} and {} shadow rays, {} and {} of them lit",
                                                 name, a.shadow, b.shadow, a.lit, b.lit));
        report.table +=
            fmt::format("{:<10}{:>12.1f}{:>10.1f}{:>10.1f}{:>10.1f}{:>12.2f}{:>12.2f}\n", name,
                        median(one) / 1e6, median(eight) / 1e6, median(ours) / 1e6,
                        median(frame) / 1e6, median(ours_ratio), median(frame_ratio));
        report.figures.push_back({{"model", name},
                                  {"bare_single", median(one)},
                                  {"bare_packet", median(eight)},
                                  {"ours", median(ours)},
                                  {"frame", median(frame)},
                                  {"ours_over_bare", median(ours_ratio)},
                                  {"frame_over_bare", median(frame_ratio)}});
    }
    return report;
}

}  // namespace

Task add_rays(CLI::App& program) {
    const auto options = std::make_shared<RenderRaysOptions>();
    CLI::App* app = program.add_subcommand("rays", "rays per second over bare loops of Embree");
    app->add_option("--size", options->size, "of the picture, a multiple of 16 [pixels]")
        ->capture_default_str();
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_render_rays(*options); }};
}

}  // namespace asperity::bench
