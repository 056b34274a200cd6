// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/random.h>
#include <asperity/render/builtin_models.h>
#include <asperity/render/traced_model.h>

#include <gtest/gtest.h>

#include <set>

namespace asperity {
namespace {

Model model_of(TriangleMesh mesh, std::vector<Transform> places) {
    Model model;
    model.name = "test";
    model.meshes.push_back(std::move(mesh));
    for (const Transform& place : places) model.instances.push_back({0, place, Role::Subject});
    return model;
}

TracedModel traced(const Model& model) {
    asperity::Run run(2);
    return TracedModel(model, run);
}

/// From somewhere within a cube of 4 to somewhere within a cube of 2.
WorldRay random_ray(std::uint64_t k) {
    const CounterRandom random(5, 0);
    const auto a = random.uniform2(k, 0), b = random.uniform2(k, 1), c = random.uniform2(k, 2);
    const Vec3 from = 4.0 * Vec3{a[0] - 0.5, a[1] - 0.5, b[0] - 0.5};
    const Vec3 to = 2.0 * Vec3{b[1] - 0.5, c[0] - 0.5, c[1] - 0.5};
    return {from, normalize(to - from)};
}

/// The nearest hit of all triangles, one by one in double precision (Moeller and Trumbore 1997).
struct PlainHit {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 normal;
    double clearance = 1;  ///< of the nearest edge of any triangle, barycentric: above 0 is sure
};
PlainHit plain_intersect(const Model& model, const WorldRay& ray) {
    PlainHit nearest;
    for (const Instance& instance : model.instances) {
        const TriangleMesh& mesh = model.meshes[instance.mesh];
        for (const auto& t : mesh.triangles) {
            const Vec3 p = instance.to_world.point(to_double(mesh.positions[t[0]]));
            const Vec3 e1 = instance.to_world.point(to_double(mesh.positions[t[1]])) - p;
            const Vec3 e2 = instance.to_world.point(to_double(mesh.positions[t[2]])) - p;
            const Vec3 h = cross(ray.direction, e2), s = ray.origin - p, q = cross(s, e1);
            const double det = dot(e1, h);
            const double u = dot(s, h) / det, v = dot(ray.direction, q) / det;
            const double distance = dot(e2, q) / det;
            if (!(distance > 0)) continue;
            const double inside = std::min({u, v, 1 - u - v});
            nearest.clearance = std::min(nearest.clearance, std::abs(inside));
            if (inside < 0 || distance >= nearest.distance) continue;
            nearest.distance = distance;
            const Vec3 n = normalize(cross(e1, e2));
            nearest.normal = dot(n, ray.direction) > 0 ? -n : n;
        }
    }
    return nearest;
}

void expect_as_plain(const Model& model) {
    const TracedModel fast = traced(model);
    int hits = 0;
    for (std::uint64_t k = 0; k < 3000; ++k) {
        const WorldRay ray = random_ray(k);
        const PlainHit plain = plain_intersect(model, ray);
        if (plain.clearance < 1e-4) continue;  // too close to an edge to be sure
        const Hit hit = fast.intersect(ray);
        const bool found = plain.distance < std::numeric_limits<double>::infinity();
        ASSERT_EQ(hit.found(), found) << k;
        EXPECT_EQ(fast.occluded(ray, std::numeric_limits<double>::infinity()), found);
        if (!found) continue;
        ++hits;
        EXPECT_TRUE(fast.occluded(ray, plain.distance + 1e-4));
        EXPECT_FALSE(fast.occluded(ray, plain.distance - 1e-4));
        const SurfacePoint point = fast.surface(ray, hit);
        const Vec3 expected = ray.origin + plain.distance * ray.direction;
        EXPECT_LT(length(point.position - expected), 2e-5);
        EXPECT_LT(length(point.geometric_normal - plain.normal), 1e-4);
        EXPECT_GT(dot(point.shading_normal, point.geometric_normal), 0);
    }
    EXPECT_GT(hits, 500);
}

// A mirror, a shear and an uneven scale at once: nothing that normals follow like vectors.
constexpr Transform kSkewed{{-0.5, 0, 0.2}, {0.3, 1, 0}, {0, 0, 0.4}, {0.2, -0.1, 0.3}};

TEST(TracedModel, MeetsWhatAPlainSearchMeets) {
    expect_as_plain(model_of(make_sphere(24, 12), {Transform{}}));
}

TEST(TracedModel, MeetsAMeshPutSkewedIntoTheWorld) {
    expect_as_plain(model_of(make_sphere(24, 12), {kSkewed}));
}

TEST(TracedModel, MeetsAMeshThatStandsInTheWorldTwice) {
    const Transform beside{{0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}, {-0.6, 0.5, 0}};
    expect_as_plain(model_of(make_sphere(24, 12), {kSkewed, beside}));
}

TEST(TracedModel, NamesTheInstanceAndItsRole) {
    TriangleMesh square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    Model model = model_of(square, {Transform{}, Transform{}});
    model.instances[1].to_world.origin = {0, 0, -1};
    model.instances[1].role = Role::Stage;
    model.meshes.push_back(square);
    model.instances.push_back({1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}}, Role::Stage});
    const TracedModel t = traced(model);
    const auto instance_at = [&](Vec3 from, Vec3 direction) {
        const WorldRay ray{from, direction};
        const Hit hit = t.intersect(ray);
        EXPECT_TRUE(hit.found());
        EXPECT_EQ(t.surface(ray, hit).role, model.instances[hit.instance].role);
        return hit.instance;
    };
    EXPECT_EQ(instance_at({0.3, 0.1, 2}, {0, 0, -1}), 0u);
    EXPECT_EQ(instance_at({0.3, 0.1, -2}, {0, 0, 1}), 1u);
    EXPECT_EQ(instance_at({5.3, 0.1, 2}, {0, 0, -1}), 2u);
    EXPECT_EQ(t.statistics(), statistics(model));
    EXPECT_EQ(t.bounds().high, bounds(model).high);
}

TEST(TracedModel, SmoothNormalsOfASkewedSphereAreItsOwn) {
    // The normals of an ellipsoid M p, |p| = 1, are along M^-T p
    const Model model = model_of(make_sphere(256, 128), {kSkewed, kSkewed});
    const TracedModel t = traced(model);
    int hits = 0;
    for (std::uint64_t k = 0; k < 1000; ++k) {
        const WorldRay ray = random_ray(k);
        const Hit hit = t.intersect(ray);
        if (!hit.found()) continue;
        ++hits;
        const SurfacePoint point = t.surface(ray, hit);
        const Transform& m = kSkewed;
        const Vec3 q = point.position - m.origin;
        // p = M^-1 q by Cramer's rule
        const double det = dot(m.x, cross(m.y, m.z));
        const Vec3 p{dot(q, cross(m.y, m.z)) / det, dot(q, cross(m.z, m.x)) / det,
                     dot(q, cross(m.x, m.y)) / det};
        const Vec3 n = normalize(
            (1 / det) * (p.x * cross(m.y, m.z) + p.y * cross(m.z, m.x) + p.z * cross(m.x, m.y)));
        EXPECT_GT(std::abs(dot(point.shading_normal, n)), 1 - 1e-6);
        EXPECT_LE(dot(point.geometric_normal, ray.direction), 0);
    }
    EXPECT_GT(hits, 200);
}

TEST(TracedModel, RaysInCompanyMeetTheSame) {
    const TracedModel t = traced(make_builtin_model("knot"));
    std::vector<WorldRay> rays;
    for (std::uint64_t k = 0; k < 4099; ++k) rays.push_back(random_ray(k));
    std::vector<Hit> hits(rays.size());
    t.intersect(rays, hits);
    const std::vector<double> distances(rays.size(), 1.0);
    std::vector<std::uint8_t> hidden(rays.size());
    t.occluded(rays, distances, hidden);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const Hit alone = t.intersect(rays[k]);
        EXPECT_EQ(alone.found(), hits[k].found());
        EXPECT_EQ(alone.triangle, hits[k].triangle);
        if (alone.found()) {
            EXPECT_NEAR(alone.distance, hits[k].distance, 1e-5);
        }
        EXPECT_EQ(t.occluded(rays[k], 1.0), hidden[k] == 1) << k;
    }
}

TEST(TracedModel, WatertightAlongEdges) {
    // Rays from the inside through the middle of every edge. Exactly through a corner the
    // roundings of six edges need not agree: a ray in a thousand may slip through.
    const Model model = model_of(make_sphere(48, 24), {Transform{}});
    const TracedModel t = traced(model);
    const TriangleMesh& mesh = model.meshes[0];
    std::set<std::uint32_t> slipped;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = to_double(mesh.positions[triangle[k]]);
            const Vec3 b = to_double(mesh.positions[triangle[(k + 1) % 3]]);
            const Vec3 inside{0.01, 0.02, 0.03};
            EXPECT_TRUE(t.intersect({inside, normalize(0.5 * (a + b) - inside)}).found());
            if (!t.intersect({inside, normalize(a - inside)}).found()) slipped.insert(triangle[k]);
        }
    EXPECT_LE(slipped.size(), 3u) << "of about 1100 corners";
}

TEST(TracedModel, RaysThatStartOffTheSurfaceDoNotMeetItAgain) {
    // A sphere is convex: nothing hides what leaves it. Far from the origin roundings are larger
    for (const double far : {0.0, 10.0, 3000.0}) {
        const Transform place{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {far, -far, 0.5 * far}};
        for (const std::size_t copies : {std::size_t{1}, std::size_t{2}}) {
            const TracedModel t =
                traced(model_of(make_sphere(64, 32), std::vector<Transform>(copies, place)));
            int hits = 0, again = 0;
            for (std::uint64_t k = 0; k < 20000; ++k) {
                WorldRay ray = random_ray(k);
                if (length(ray.origin) < 1.1) continue;
                ray.origin = ray.origin + place.origin;
                const Hit hit = t.intersect(ray);
                if (!hit.found()) continue;
                ++hits;
                const SurfacePoint point = t.surface(ray, hit);
                EXPECT_LT(point.offset, 1e-5 * (1 + 3 * far));
                const Vec3 start = point.position + point.offset * point.geometric_normal;
                // Grazing: along the triangle
                const Vec3 along = normalize(cross(point.geometric_normal, ray.direction));
                const Vec3 out = normalize(along + 1e-3 * point.geometric_normal);
                if (t.occluded({start, out}, std::numeric_limits<double>::infinity())) ++again;
            }
            EXPECT_GT(hits, 3000) << far;
            EXPECT_EQ(again, 0) << far << ' ' << copies;
        }
    }
}

TEST(TracedModel, HearsAWishToStopAndRefusesBadModels) {
    asperity::Run run(1);
    run.request_stop();
    try {
        const TracedModel t(make_builtin_model("sphere"), run);
        FAIL() << "was built";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Stopped);
    }
    Model broken = model_of(make_sphere(8, 4), {Transform{}});
    broken.meshes[0].triangles[3][1] = 100000;
    asperity::Run other(1);
    EXPECT_THROW(TracedModel(broken, other), Error);
}

TEST(TracedModel, TakesAModelWithoutTrianglesAndOneWithFlatOnes) {
    const TracedModel none = traced(Model{});
    EXPECT_FALSE(none.intersect(random_ray(1)).found());
    TriangleMesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.triangles = {{0, 1, 2}, {0, 0, 0}};
    const TracedModel line = traced(model_of(flat, {Transform{}}));
    for (std::uint64_t k = 0; k < 100; ++k) {
        WorldRay ray = random_ray(k);
        ray.direction = normalize(Vec3{1, 0, 0} - ray.origin);
        const Hit hit = line.intersect(ray);
        if (!hit.found()) continue;
        const SurfacePoint point = line.surface(ray, hit);
        EXPECT_NEAR(length(point.geometric_normal), 1, 1e-12);
    }
}

}  // namespace
}  // namespace asperity
