// SPDX-License-Identifier: Apache-2.0
// A mesh that stands in the world once is put there as it is; one that stands there several times
// is a scene of its own, which Embree instances. Embree numbers both by the instance of the Model.
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/render/traced_model.h>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace asperity {

namespace {

/// Rays in a packet; Embree splits packets that are too wide for the machine.
constexpr std::size_t kLanes = 8;

Vec3f to_float(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

double largest(Vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The columns of a matrix that turns normals as `t` turns surfaces: its inverse transposed, up to
/// a factor (the cofactors), so that a mirror or a shear does no harm.
std::array<Vec3, 3> normal_columns(const Transform& t) {
    return {cross(t.y, t.z), cross(t.z, t.x), cross(t.x, t.y)};
}

Vec3 turn_normal(const std::array<Vec3, 3>& columns, Vec3 n) {
    return n.x * columns[0] + n.y * columns[1] + n.z * columns[2];
}

/// A unit vector along `v`, or `fallback` where it has no direction.
Vec3 unit_or(Vec3 v, Vec3 fallback) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? (1 / size) * v : fallback;
}

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

/// The triangles of one mesh, as Embree reads them in place.
struct Shape {
    std::vector<Vec3f> positions;  ///< and one more: Embree reads 16 bytes from each
    std::vector<Vec3f> normals;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Owned<RTCScene> scene;  ///< of its own, when instanced
};

/// How far a ray from a triangle must start off it; `size`: the largest of the coordinates of its
/// corners, before they are put into the world.
double offset_at(const Transform& to_world, double size) {
    // Coordinates are rounded to 2^-24 of their size, in the world and before they came there; a
    // ray meets a triangle with the error of a few such roundings
    constexpr double kRoundings = 32 * 0x1p-24;
    const double stretch = largest(to_world.x) + largest(to_world.y) + largest(to_world.z);
    return kRoundings * (size * stretch + largest(to_world.origin));
}

/// An instance of the Model.
struct Part {
    std::size_t shape = 0;
    Transform to_world;  ///< of the shape's vertices
    std::array<Vec3, 3> normal_columns;
    Role role = Role::Subject;
};

Shape copy_of(const TriangleMesh& mesh, const Transform& to_world) {
    Shape shape;
    shape.triangles = mesh.triangles;
    shape.positions.reserve(mesh.positions.size() + 1);
    for (const Vec3f p : mesh.positions)
        shape.positions.push_back(to_float(to_world.point(to_double(p))));
    shape.positions.emplace_back();
    const std::array<Vec3, 3> columns = normal_columns(to_world);
    shape.normals.reserve(mesh.normals.size());
    for (const Vec3f n : mesh.normals)
        shape.normals.push_back(to_float(unit_or(turn_normal(columns, to_double(n)), Vec3{})));
    return shape;
}

void write(RTCRay& out, const WorldRay& ray, double distance) {
    const Vec3f o = to_float(ray.origin), d = to_float(ray.direction);
    out.org_x = o.x, out.org_y = o.y, out.org_z = o.z;
    out.dir_x = d.x, out.dir_y = d.y, out.dir_z = d.z;
    out.tnear = 0, out.tfar = static_cast<float>(distance), out.time = 0;
    out.mask = ~0u, out.id = 0, out.flags = 0;
}

void write(RTCRay8& out, std::size_t lane, const WorldRay& ray, double distance) {
    const Vec3f o = to_float(ray.origin), d = to_float(ray.direction);
    out.org_x[lane] = o.x, out.org_y[lane] = o.y, out.org_z[lane] = o.z;
    out.dir_x[lane] = d.x, out.dir_y[lane] = d.y, out.dir_z[lane] = d.z;
    out.tnear[lane] = 0, out.tfar[lane] = static_cast<float>(distance), out.time[lane] = 0;
    out.mask[lane] = ~0u, out.id[lane] = 0, out.flags[lane] = 0;
}

/// Makes a scene ready for rays, and tells the run of its triangles; does nothing, or half of it,
/// when the run is to be stopped.
void build(RTCScene scene, std::size_t triangles, Run& run) {
    struct Watch {
        Run& run;
        double triangles;
        std::uint64_t told = 0;
    } watch{run, static_cast<double>(triangles)};
    rtcSetSceneProgressMonitorFunction(
        scene,
        [](void* of, double share) {
            auto& w = *static_cast<Watch*>(of);
            const auto done = static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * w.triangles);
            if (done > w.told) w.run.advance(done - std::exchange(w.told, done));
            return !w.run.stop_requested();
        },
        &watch);
    // One thread for each scene: how several share one decides which of two triangles is met by
    // a ray through their common edge
    tbb::task_arena(1).execute([&] { rtcCommitScene(scene); });
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

/// Of the two numbers Embree gives, the one that is the Model's instance.
std::uint32_t instance_of(unsigned outer, unsigned geometry) {
    return outer == RTC_INVALID_GEOMETRY_ID ? geometry : outer;
}

}  // namespace

struct TracedModel::Embree {
    std::mutex complaint_mutex;
    std::string complaint;  ///< Embree's first, if there is any
    Owned<RTCDevice> device;
    std::vector<Shape> shapes;
    std::vector<Part> parts;
    Owned<RTCScene> world;
    Bounds bounds;
    ModelStatistics statistics;

    Embree(const Model& model, Run& run);

    void add_shapes(const Model& model);
    void build_scenes(Run& run);
    Owned<RTCScene> new_scene();
    void attach(RTCScene scene, const Shape& shape, unsigned id);
    void attach_instance(unsigned id);
    void expect_ok(const Run& run);

    SurfacePoint surface(const WorldRay& ray, const Hit& hit) const;
};

TracedModel::Embree::Embree(const Model& model, Run& run) {
    check(model);
    bounds = asperity::bounds(model);
    statistics = asperity::statistics(model);
    // Not "threads=1": that would hold back all threads of the program as long as the device lives
    device.reset(rtcNewDevice(nullptr));
    if (device == nullptr) throw Error(ErrorCode::OutOfMemory, "no device for tracing");
    rtcSetDeviceErrorFunction(
        device.get(),
        [](void* embree, RTCError, const char* text) {
            auto& self = *static_cast<Embree*>(embree);
            const std::lock_guard lock(self.complaint_mutex);
            if (self.complaint.empty()) self.complaint = text != nullptr ? text : "unknown error";
        },
        this);
    add_shapes(model);
    build_scenes(run);
}

void TracedModel::Embree::add_shapes(const Model& model) {
    std::vector<std::size_t> uses(model.meshes.size(), 0), shape_of(model.meshes.size());
    for (const Instance& instance : model.instances) ++uses[instance.mesh];
    std::vector<bool> copied(model.meshes.size(), false);
    for (const Instance& instance : model.instances) {
        const std::size_t mesh = instance.mesh;
        const bool shared = uses[mesh] > 1;
        if (!copied[mesh]) {
            shape_of[mesh] = shapes.size();
            shapes.push_back(copy_of(model.meshes[mesh], shared ? Transform{} : instance.to_world));
            copied[mesh] = true;
            if (shared) shapes.back().scene = new_scene();
        }
        const Transform rest = shared ? instance.to_world : Transform{};
        parts.push_back({shape_of[mesh], rest, normal_columns(rest), instance.role});
    }
}

void TracedModel::Embree::build_scenes(Run& run) {
    run.begin("building the scene", statistics.unique_triangles);
    // What is instanced comes first
    std::vector<const Shape*> shared;
    for (const Shape& shape : shapes)
        if (shape.scene != nullptr) shared.push_back(&shape);
    for (const Shape* shape : shared) attach(shape->scene.get(), *shape, 0);
    parallel_for(shared.size(), run.threads(), [&](std::size_t k) {
        build(shared[k]->scene.get(), shared[k]->triangles.size(), run);
    });
    expect_ok(run);

    world = new_scene();
    std::size_t triangles = 0;
    for (unsigned id = 0; id < parts.size(); ++id) {
        const Shape& shape = shapes[parts[id].shape];
        if (shape.scene != nullptr) {
            attach_instance(id);
        } else {
            attach(world.get(), shape, id);
            triangles += shape.triangles.size();
        }
    }
    build(world.get(), triangles, run);
    expect_ok(run);
    run.end();
}

Owned<RTCScene> TracedModel::Embree::new_scene() {
    Owned<RTCScene> scene(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

void TracedModel::Embree::attach(RTCScene scene, const Shape& shape, unsigned id) {
    const RTCGeometry mesh = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               shape.positions.data(), 0, sizeof(Vec3f),
                               shape.positions.size() - 1);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               shape.triangles.data(), 0, sizeof(shape.triangles[0]),
                               shape.triangles.size());
    rtcCommitGeometry(mesh);
    rtcAttachGeometryByID(scene, mesh, id);
    rtcReleaseGeometry(mesh);
}

void TracedModel::Embree::attach_instance(unsigned id) {
    const Part& part = parts[id];
    const RTCGeometry instance = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, shapes[part.shape].scene.get());
    const Transform& t = part.to_world;
    const std::array<Vec3f, 4> columns = {to_float(t.x), to_float(t.y), to_float(t.z),
                                          to_float(t.origin)};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(world.get(), instance, id);
    rtcReleaseGeometry(instance);
}

void TracedModel::Embree::expect_ok(const Run& run) {
    if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped while building the scene");
    // Embree's own memory of errors is that of each thread
    const std::lock_guard lock(complaint_mutex);
    if (!complaint.empty())
        throw Error(ErrorCode::OutOfMemory, "the scene cannot be built: " + complaint);
}

SurfacePoint TracedModel::Embree::surface(const WorldRay& ray, const Hit& hit) const {
    const Part& part = parts[hit.instance];
    const Shape& shape = shapes[part.shape];
    const auto& corners = shape.triangles[hit.triangle];
    const double u = static_cast<double>(hit.u), v = static_cast<double>(hit.v), w = 1 - u - v;
    const Vec3 p0 = to_double(shape.positions[corners[0]]),
               p1 = to_double(shape.positions[corners[1]]),
               p2 = to_double(shape.positions[corners[2]]);

    SurfacePoint point;
    point.role = part.role;
    const Vec3 local = w * p0 + u * p1 + v * p2;
    point.position = part.to_world.point(local);
    point.offset = offset_at(part.to_world, std::max({largest(p0), largest(p1), largest(p2)}));

    // The triangle's normal, towards the ray
    const Vec3 across = turn_normal(part.normal_columns, cross(p1 - p0, p2 - p0));
    const Vec3 normal = unit_or(across, -ray.direction);
    point.geometric_normal = dot(normal, ray.direction) > 0 ? -normal : normal;

    // The mesh's normal, on the same side
    point.shading_normal = point.geometric_normal;
    if (!shape.normals.empty()) {
        const Vec3 mixed = w * to_double(shape.normals[corners[0]]) +
                           u * to_double(shape.normals[corners[1]]) +
                           v * to_double(shape.normals[corners[2]]);
        const Vec3 smooth = unit_or(turn_normal(part.normal_columns, mixed), point.shading_normal);
        point.shading_normal = dot(smooth, point.geometric_normal) < 0 ? -smooth : smooth;
    }
    return point;
}

TracedModel::TracedModel(const Model& model, Run& run)
    : embree_(std::make_unique<Embree>(model, run)) {}
TracedModel::~TracedModel() = default;
TracedModel::TracedModel(TracedModel&&) noexcept = default;
TracedModel& TracedModel::operator=(TracedModel&&) noexcept = default;

Hit TracedModel::intersect(const WorldRay& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit found;
    write(found.ray, ray, std::numeric_limits<double>::infinity());
    found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->world.get(), &context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {found.ray.tfar, found.hit.u, found.hit.v,
            instance_of(found.hit.instID[0], found.hit.geomID), found.hit.primID};
}

void TracedModel::intersect(std::span<const WorldRay> rays, std::span<Hit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - first);
        RTCRayHit8 found;
        alignas(32) std::array<int, kLanes> valid{};
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            valid[lane] = lane < count ? -1 : 0;
            write(found.ray, lane, rays[first + std::min(lane, count - 1)],
                  std::numeric_limits<double>::infinity());
            found.hit.geomID[lane] = found.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid.data(), embree_->world.get(), &context, &found);
        for (std::size_t lane = 0; lane < count; ++lane) {
            Hit& hit = hits[first + lane];
            hit = {};
            if (found.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
            hit = {found.ray.tfar[lane], found.hit.u[lane], found.hit.v[lane],
                   instance_of(found.hit.instID[0][lane], found.hit.geomID[lane]),
                   found.hit.primID[lane]};
        }
    }
}

bool TracedModel::occluded(const WorldRay& ray, double distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay shadow;
    write(shadow, ray, distance);
    rtcOccluded1(embree_->world.get(), &context, &shadow);
    return shadow.tfar < 0;
}

void TracedModel::occluded(std::span<const WorldRay> rays, std::span<const double> distances,
                           std::span<std::uint8_t> hidden) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - first);
        RTCRay8 shadows;
        alignas(32) std::array<int, kLanes> valid{};
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            valid[lane] = lane < count ? -1 : 0;
            const std::size_t k = first + std::min(lane, count - 1);
            write(shadows, lane, rays[k], distances[k]);
        }
        rtcOccluded8(valid.data(), embree_->world.get(), &context, &shadows);
        for (std::size_t lane = 0; lane < count; ++lane)
            hidden[first + lane] = shadows.tfar[lane] < 0 ? 1 : 0;
    }
}

SurfacePoint TracedModel::surface(const WorldRay& ray, const Hit& hit) const {
    return embree_->surface(ray, hit);
}

Bounds TracedModel::bounds() const {
    return embree_->bounds;
}

ModelStatistics TracedModel::statistics() const {
    return embree_->statistics;
}

}  // namespace asperity
