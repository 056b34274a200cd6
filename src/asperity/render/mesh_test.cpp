// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/mesh.h>

#include <asperity/core/error.h>
#include <asperity/render/builtin_models.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

/// The cube -1 .. 1 with 8 vertices; the squares are cut along any diagonal.
TriangleMesh cube() {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back({(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 1.0f : -1.0f,
                                  (i & 4) != 0 ? 1.0f : -1.0f});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// Two triangles that meet in the line from (0,0,0) to (0,0,1), opened by `angle` from flat.
TriangleMesh roof(double angle) {
    TriangleMesh mesh;
    const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(-std::sin(angle));
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {x, y, 0}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    return mesh;
}

Model model_of(TriangleMesh mesh) {
    Model model;
    model.name = "test";
    model.meshes.push_back(std::move(mesh));
    model.instances.push_back({});
    return model;
}

void expect_near(Vec3f a, Vec3 b) {
    EXPECT_NEAR(static_cast<double>(a.x), b.x, 1e-6);
    EXPECT_NEAR(static_cast<double>(a.y), b.y, 1e-6);
    EXPECT_NEAR(static_cast<double>(a.z), b.z, 1e-6);
}

TEST(Mesh, StatisticsCountUniqueAndInstanced) {
    Model model = model_of(cube());
    model.meshes.push_back(make_sphere(8, 4));  // 48 triangles, 45 vertices
    model.meshes.push_back(cube());             // stands nowhere
    model.instances.push_back({0, {}, Role::Stage});
    model.instances.push_back({1, {}, Role::Subject});
    const ModelStatistics expected{3, 3, 12 + 48 + 12, 8 + 45 + 8, 2 * 12 + 48, 2 * 8 + 45};
    EXPECT_EQ(statistics(model), expected);
    EXPECT_EQ(statistics(Model{}), ModelStatistics{});
}

TEST(Mesh, BoundsLieInTheWorldAndLeaveUnusedVerticesOut) {
    Model model = model_of(cube());
    model.meshes[0].positions.push_back({100, kNan, 0});
    model.instances[0].to_world = {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 0, 0}};
    const Bounds box = bounds(model);
    EXPECT_EQ(box.low, (Vec3{8, -1, -1}));
    EXPECT_EQ(box.high, (Vec3{12, 1, 1}));
    EXPECT_TRUE(bounds(Model{}).empty());
}

// The cube's corners lie sqrt(3) from its centre.
TEST(Mesh, FitCentresAndScalesByTheFarthestVertex) {
    Model model = model_of(cube());
    model.instances[0].to_world.origin = {5, 6, 7};
    const TriangleMesh before = model.meshes[0];
    fit_to_unit_sphere(model);
    EXPECT_EQ(model.meshes[0].positions, before.positions);
    const double side = 1 / std::sqrt(3.0);
    EXPECT_NEAR(bounds(model).high.x, side, 1e-15);
    EXPECT_NEAR(bounds(model).low.z, -side, 1e-15);

    Model point = model_of({"", {{3, 3, 3}}, {}, {{0, 0, 0}}});
    fit_to_unit_sphere(point);
    EXPECT_EQ(bounds(point).high, (Vec3{0, 0, 0}));

    Model nothing;
    EXPECT_NO_THROW(fit_to_unit_sphere(nothing));
}

TEST(Mesh, FitWorksForLargeAndSmallModels) {
    for (const double size : {1e-30, 1e-6, 1e6, 1e30}) {
        Model model = model_of(cube());
        model.instances[0].to_world = {{size, 0, 0}, {0, size, 0}, {0, 0, size}, {0, 0, 0}};
        fit_to_unit_sphere(model);
        EXPECT_NEAR(length(bounds(model).high), 1, 1e-12) << size;
    }
}

TEST(Mesh, CheckNamesWhatIsWrong) {
    const auto fault = [](auto damage) {
        Model model = model_of(cube());
        damage(model);
        try {
            check(model);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_EQ(error.where(), "test");
            return error.message();
        }
        return std::string();
    };
    EXPECT_EQ(fault([](Model&) {}), "");
    EXPECT_EQ(fault([](Model& m) { m.meshes[0].triangles[3][1] = 8; }),
              "mesh 0: triangle 3 refers to vertex 8, there are 8");
    EXPECT_EQ(fault([](Model& m) { m.meshes[0].positions[5].y = kFloatInfinity; }),
              "mesh 0: vertex 5 is not finite");
    EXPECT_EQ(fault([](Model& m) { m.meshes[0].positions.push_back({kNan, 0, 0}); }), "");
    EXPECT_EQ(fault([](Model& m) { m.meshes[0].normals.resize(7); }),
              "mesh 0: 7 normals for 8 vertices");
    EXPECT_EQ(fault([](Model& m) { m.instances[0].mesh = 1; }),
              "instance 0 is of mesh 1, there are 1");
    EXPECT_EQ(fault([](Model& m) { m.instances[0].to_world.y.z = std::nan(""); }),
              "the transform of instance 0 is not finite");
}

// Three squares meet in each corner, with 90 degrees each however they are cut: the mean is the
// diagonal. A mean weighted by area or by number would lean to the squares cut through the corner.
TEST(Normals, SmoothOnACubeAreDiagonals) {
    TriangleMesh mesh = cube();
    set_normals(mesh, NormalStyle::Smooth);
    ASSERT_EQ(mesh.positions.size(), 8u);
    for (std::size_t v = 0; v < 8; ++v)
        expect_near(mesh.normals[v], normalize(to_double(mesh.positions[v])));
}

TEST(Normals, CreaseKeepsTheEdgesOfACube) {
    TriangleMesh mesh = cube();
    const TriangleMesh before = mesh;
    set_normals(mesh, NormalStyle::Smooth, 60);
    EXPECT_EQ(mesh.positions.size(), 24u);  // three normals in each of 8 corners
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 facet =
            normalize(cross(to_double(before.positions[before.triangles[t][1]]) -
                                to_double(before.positions[before.triangles[t][0]]),
                            to_double(before.positions[before.triangles[t][2]]) -
                                to_double(before.positions[before.triangles[t][0]])));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.triangles[t][k];
            EXPECT_EQ(mesh.positions[v], before.positions[before.triangles[t][k]]);
            expect_near(mesh.normals[v], facet);
        }
    }
    EXPECT_NO_THROW(check(model_of(mesh)));
}

TEST(Normals, CreaseTakesEffectAtItsAngle) {
    TriangleMesh mesh = roof(0.5);  // 28.65 degrees
    set_normals(mesh, NormalStyle::Smooth, 28);
    EXPECT_EQ(mesh.positions.size(), 6u);
    expect_near(mesh.normals[0], {0, 1, 0});
    mesh = roof(0.5);
    set_normals(mesh, NormalStyle::Smooth, 29);
    EXPECT_EQ(mesh.positions.size(), 4u);
    // Both facets have the same angle at the ridge's first end.
    expect_near(mesh.normals[0], {std::sin(0.25), std::cos(0.25), 0});
}

TEST(Normals, VerticesAtOnePlaceCountAsOne) {
    // The cube with three vertices of its own for each triangle.
    const TriangleMesh shared = cube();
    TriangleMesh mesh;
    for (const auto& t : shared.triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::uint32_t v : t) mesh.positions.push_back(Vec3f(shared.positions[v]));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    // 0 and -0 are one place.
    set_normals(mesh, NormalStyle::Smooth);
    ASSERT_EQ(mesh.positions.size(), 36u);
    for (std::size_t v = 0; v < 36; ++v)
        expect_near(mesh.normals[v], normalize(to_double(mesh.positions[v])));
}

TEST(Normals, OfASphereAreItsRadii) {
    TriangleMesh mesh = make_sphere(128, 64);
    const std::vector<Vec3f> exact = mesh.normals;
    set_normals(mesh, NormalStyle::Smooth);
    double worst = 1;
    for (std::size_t v = 0; v < exact.size(); ++v) {
        const bool used = to_double(exact[v]) == to_double(mesh.positions[v]);
        if (used && std::abs(exact[v].y) < 0.999f)
            worst = std::min(worst, dot(to_double(exact[v]), to_double(mesh.normals[v])));
    }
    EXPECT_GT(worst, 0.9999);
}

TEST(Normals, FacetsThatCancelKeepTheirOwn) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};  // a sheet with two sides
    set_normals(mesh, NormalStyle::Smooth);
    ASSERT_EQ(mesh.positions.size(), 6u);
    for (const std::uint32_t v : mesh.triangles[0]) expect_near(mesh.normals[v], {0, 0, 1});
    for (const std::uint32_t v : mesh.triangles[1]) expect_near(mesh.normals[v], {0, 0, -1});
}

TEST(Normals, FacetsWithoutAreaHaveNoSay) {
    TriangleMesh mesh = roof(0);
    mesh.positions.push_back({0, 0, 2});
    mesh.triangles.push_back({0, 1, 4});  // a line
    for (const double crease : {180.0, 30.0}) {
        TriangleMesh copy = mesh;
        set_normals(copy, NormalStyle::Smooth, crease);
        for (const std::uint32_t v : {0u, 1u, 2u, 3u}) expect_near(copy.normals[v], {0, 1, 0});
        EXPECT_NO_THROW(check(model_of(copy)));
        for (const Vec3f n : copy.normals) EXPECT_NEAR(length(to_double(n)), 1, 1e-6);
    }
}

TEST(Normals, StylesTakeOrLeaveWhatIsGiven) {
    TriangleMesh mesh = make_sphere(8, 4);
    const std::vector<Vec3f> given = mesh.normals;
    set_normals(mesh, NormalStyle::AsGiven);
    EXPECT_EQ(mesh.normals, given);
    set_normals(mesh, NormalStyle::Facet);
    EXPECT_TRUE(mesh.normals.empty());
    set_normals(mesh, NormalStyle::AsGiven);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_THROW(set_normals(mesh, NormalStyle::Smooth, 181), Error);
    EXPECT_THROW(set_normals(mesh, NormalStyle::Smooth, std::nan("")), Error);
}

// Corners that all differ at one vertex must not cost their square.
TEST(Normals, FanOfManyCreasesTakesNoTime) {
    TriangleMesh mesh;
    mesh.positions.push_back({0, 0, 0});
    constexpr std::uint32_t kBlades = 200000;
    for (std::uint32_t i = 0; i < kBlades; ++i) {
        const auto angle = static_cast<float>(i) * 1e-4f;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), static_cast<float>(i)});
        mesh.positions.push_back({std::cos(angle), std::sin(angle), static_cast<float>(i) + 0.5f});
        mesh.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
    }
    set_normals(mesh, NormalStyle::Smooth, 1);
    EXPECT_NO_THROW(check(model_of(mesh)));
}

TEST(DropUndrawable, TakesOutWhatHasNoAreaOrIsNotFinite) {
    TriangleMesh mesh = cube();
    mesh.positions.push_back({kNan, 0, 0});
    mesh.positions.push_back({0, kFloatInfinity, 0});
    mesh.triangles.push_back({0, 1, 8});
    mesh.triangles.push_back({0, 9, 1});
    mesh.triangles.push_back({3, 3, 5});
    mesh.positions.push_back({0, -1, -1});  // halfway between 0 and 1
    mesh.triangles.push_back({0, 10, 1});
    EXPECT_EQ(drop_undrawable(mesh), 4u);
    EXPECT_EQ(mesh.triangles, cube().triangles);
    EXPECT_EQ(drop_undrawable(mesh), 0u);
}

TEST(DropUndrawable, KeepsThinAndTinyTriangles) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1e-6f, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    EXPECT_EQ(drop_undrawable(mesh), 0u);
}

TEST(DropUndrawable, MendsNormals) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}};
    mesh.triangles = {{0, 1, 2}};
    mesh.normals = {{0, 3, 4}, {0, 0, 0}, {kNan, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(drop_undrawable(mesh), 0u);
    expect_near(mesh.normals[0], {0, 0.6, 0.8});
    expect_near(mesh.normals[1], {0, 0, 1});
    expect_near(mesh.normals[2], {0, 0, 1});
    EXPECT_EQ(mesh.normals[3], (Vec3f{0, 1, 0}));
}

}  // namespace
}  // namespace asperity
