// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/builtin_models.h>

#include <asperity/core/error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace asperity {
namespace {

/// What a mesh is when vertices at one place are one.
struct Topology {
    std::int64_t vertices = 0, edges = 0, faces = 0;
    bool closed = false;  ///< every edge is run along once in each direction
    double volume = 0;    ///< signed: positive when facets turn outwards

    std::int64_t euler() const { return vertices - edges + faces; }
};

Topology topology(const TriangleMesh& mesh) {
    const auto key = [](Vec3f p) { return std::tuple(p.x, p.y, p.z); };
    const auto less = [&](Vec3f a, Vec3f b) { return key(a) < key(b); };
    std::vector<Vec3f> places = mesh.positions;
    std::sort(places.begin(), places.end(), less);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<std::uint64_t> place;
    for (const Vec3f p : mesh.positions) {
        const auto found = std::lower_bound(places.begin(), places.end(), p, less);
        place.push_back(static_cast<std::uint64_t>(found - places.begin()));
    }

    Topology result;
    std::vector<std::uint64_t> edges, twins;  // from << 32 | to
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t from = place[t[k]], to = place[t[(k + 1) % 3]];
            edges.push_back((from << 32) | to);
            twins.push_back((to << 32) | from);
        }
        // The tetrahedron from the origin to the triangle.
        const Vec3 a = to_double(mesh.positions[t[0]]);
        const Vec3 b = to_double(mesh.positions[t[1]]), c = to_double(mesh.positions[t[2]]);
        result.volume += dot(a, cross(b, c)) / 6;
    }
    std::sort(edges.begin(), edges.end());
    std::sort(twins.begin(), twins.end());
    const bool once = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
    result.closed = once && edges == twins;
    result.vertices = static_cast<std::int64_t>(places.size());
    result.faces = static_cast<std::int64_t>(mesh.triangles.size());
    result.edges = static_cast<std::int64_t>(edges.size()) / 2;  // when closed
    return result;
}

/// The smallest cosine between a triangle and the normals at its corners.
double worst_normal(const TriangleMesh& mesh) {
    double worst = 1;
    for (const auto& t : mesh.triangles) {
        const Vec3 p = to_double(mesh.positions[t[0]]);
        const Vec3 facet = normalize(
            cross(to_double(mesh.positions[t[1]]) - p, to_double(mesh.positions[t[2]]) - p));
        for (const std::uint32_t v : t)
            worst = std::min(worst, dot(facet, to_double(mesh.normals[v])));
    }
    return worst;
}

TEST(BuiltinModels, NamesArePartOfTheCommandLine) {
    std::vector<std::string> names;
    for (const BuiltinModel& model : builtin_models()) {
        names.push_back(model.name);
        EXPECT_FALSE(model.description.empty());
        EXPECT_TRUE(is_builtin_model(model.name));
        EXPECT_EQ(make_builtin_model(model.name).name, model.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"sphere", "plane", "knot", "ball", "bowl"}));
    EXPECT_FALSE(is_builtin_model("teapot"));
    try {
        make_builtin_model("teapot");
        FAIL() << "there is no teapot";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        EXPECT_EQ(error.where(), "model");
        EXPECT_NE(error.message().find("sphere, plane, knot, ball, bowl"), std::string::npos);
    }
}

// A sphere of s slices and t stacks has two caps of s triangles and t - 2 belts of 2 s.
TEST(BuiltinModels, SphereHasTheCountsOfItsSlicesAndStacks) {
    for (const auto& [slices, stacks] : {std::pair(3, 2), {8, 5}, {33, 20}}) {
        const TriangleMesh sphere = make_sphere(slices, stacks);
        EXPECT_EQ(sphere.positions.size(), static_cast<std::size_t>((slices + 1) * (stacks + 1)));
        EXPECT_EQ(sphere.triangles.size(), static_cast<std::size_t>(2 * slices * (stacks - 1)));
        const Topology t = topology(sphere);
        EXPECT_TRUE(t.closed);
        EXPECT_EQ(t.euler(), 2);
        // Without the seam and the poles: a vertex for each slice and inner stack, and two.
        EXPECT_EQ(t.vertices, slices * (stacks - 1) + 2);
    }
}

// The volume of a polyhedron whose corners lie on the sphere falls short of 4 pi / 3 in proportion
// to the square of the step.
TEST(BuiltinModels, SphereIsASphere) {
    const TriangleMesh sphere = make_sphere(512, 256);
    for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
        EXPECT_NEAR(length(to_double(sphere.positions[v])), 1, 1e-7);
        EXPECT_EQ(sphere.positions[v], sphere.normals[v]);
    }
    const double whole = 4 * std::acos(-1.0) / 3;
    const double missing = whole - topology(sphere).volume;
    const double missing_coarse = whole - topology(make_sphere(256, 128)).volume;
    EXPECT_GT(missing, 0);
    EXPECT_NEAR(missing_coarse / missing, 4, 0.01);
    EXPECT_EQ(sphere.positions.front(), (Vec3f{0, 1, 0}));
    EXPECT_EQ(sphere.positions.back(), (Vec3f{0, -1, 0}));
}

TEST(BuiltinModels, SphereRefusesWhatIsNoSphere) {
    const auto where = [](int slices, int stacks) {
        try {
            make_sphere(slices, stacks);
        } catch (const Error& error) {
            return error.where();
        }
        return std::string("no error");
    };
    EXPECT_EQ(where(2, 8), "slices");
    EXPECT_EQ(where(8, 1), "stacks");
    EXPECT_EQ(where(1 << 30, 8), "slices");
    EXPECT_EQ(where(8, 1 << 30), "stacks");
}

TEST(BuiltinModels, PlaneIsTheSquareFacingUp) {
    const Model plane = make_builtin_model("plane");
    const Bounds box = bounds(plane);
    EXPECT_EQ(box.low, (Vec3{-1, 0, -1}));
    EXPECT_EQ(box.high, (Vec3{1, 0, 1}));
    ASSERT_EQ(plane.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(worst_normal(plane.meshes[0]), 1);
    EXPECT_EQ(plane.meshes[0].normals[0], (Vec3f{0, 1, 0}));
}

// Euler's characteristic: 2 for a body without a hole, 0 for a ring, however it is knotted.
TEST(BuiltinModels, BodiesAreClosedAndTurnedOutwards) {
    for (const char* name : {"sphere", "knot", "ball", "bowl"}) {
        const Model model = make_builtin_model(name);
        EXPECT_NO_THROW(check(model));
        for (const TriangleMesh& mesh : model.meshes) {
            SCOPED_TRACE(std::string(name) + ": " + mesh.name);
            const Topology t = topology(mesh);
            EXPECT_TRUE(t.closed);
            EXPECT_EQ(t.euler(), mesh.name == "knot" ? 0 : 2);
            EXPECT_GT(t.volume, 0.05);
            // Fine enough that shading normals never stray far from their facets.
            EXPECT_GT(worst_normal(mesh), std::cos(0.32));
            double off = 0;
            for (const Vec3f n : mesh.normals)
                off = std::max(off, std::abs(length(to_double(n)) - 1));
            EXPECT_LT(off, 1e-6);
        }
    }
}

// Pappus: a tube's volume is its section times the way of its middle. 3 and 2 turns give, with
// rho = 1 + cos(3 t) / 2, the way integral of sqrt(9 / 4 + 4 rho^2) over 0 .. 2 pi.
TEST(BuiltinModels, KnotHasTheVolumeOfItsTube) {
    const double pi = std::acos(-1.0);
    double way = 0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double rho = 1 + 0.5 * std::cos(3 * 2 * pi * i / kSteps);
        way += std::sqrt(2.25 + 4 * rho * rho) * 2 * pi / kSteps;
    }
    const double tube = pi * 0.26 * 0.26 * way;
    const TriangleMesh knot = make_builtin_model("knot").meshes[0];
    EXPECT_NEAR(topology(knot).volume, tube, 0.002 * tube);
}

TEST(BuiltinModels, FitTheUnitSphere) {
    for (const char* name : {"sphere", "knot", "ball", "bowl"}) {
        const Model model = make_builtin_model(name);
        double farthest = 0;
        for (const Instance& instance : model.instances) {
            for (const Vec3f p : model.meshes[instance.mesh].positions)
                farthest = std::max(farthest, length(instance.to_world.point(to_double(p))));
        }
        EXPECT_NEAR(farthest, 1, 1e-6) << name;
        EXPECT_NEAR(length(bounds(model).centre()), 0, 1e-7) << name;
    }
}

TEST(BuiltinModels, OnlyTheDishIsSomethingToStandOn) {
    const Model ball = make_builtin_model("ball");
    ASSERT_EQ(ball.meshes.size(), 3u);
    for (const Instance& instance : ball.instances) {
        const bool dish = ball.meshes[instance.mesh].name == "dish";
        EXPECT_EQ(instance.role, dish ? Role::Stage : Role::Subject);
    }
}

TEST(BuiltinModels, FloorLiesJustBelowAndFacesUp) {
    Model model = make_builtin_model("knot");
    const Bounds before = bounds(model);
    add_floor(model, 5);
    EXPECT_NO_THROW(check(model));
    const Instance& floor = model.instances.back();
    EXPECT_EQ(floor.role, Role::Stage);
    EXPECT_NEAR(worst_normal(model.meshes[floor.mesh]), 1, 1e-12);
    const Bounds after = bounds(model);
    EXPECT_LT(after.low.y, before.low.y);
    EXPECT_GT(after.low.y, before.low.y - 0.002);
    EXPECT_EQ(after.high.y, before.high.y);
    EXPECT_NEAR(after.high.x, 5, 1e-6);
    EXPECT_THROW(add_floor(model, 0), Error);
    EXPECT_THROW(add_floor(model, std::nan("")), Error);

    Model nothing;
    add_floor(nothing, 2);
    EXPECT_EQ(bounds(nothing).low, (Vec3{-2, 0, -2}));
}

}  // namespace
}  // namespace asperity
