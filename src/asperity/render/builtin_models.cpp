// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/builtin_models.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/surface_sweep.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace asperity {
namespace {

using detail::SweepEnds;
using detail::SweptVertex;

// So that all vertices can be counted in 32 bits.
constexpr int kMostOnASide = 32768;

/// 0 up to `from`, 1 from `to` on, between them a smooth step with two continuous derivatives.
double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
}

/// Turned about x, so that what points up leans towards the viewer.
Transform leaning(double angle_deg, Vec3 origin = {}) {
    const double c = std::cos(radians(angle_deg)), s = std::sin(radians(angle_deg));
    return {{1, 0, 0}, {0, c, s}, {0, -s, c}, origin};
}

Transform scaled(double scale, Vec3 origin) {
    return {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, origin};
}

Model one_mesh(TriangleMesh mesh) {
    Model model;
    model.meshes.push_back(std::move(mesh));
    model.instances.push_back({});
    return model;
}

Model make_plane() {
    TriangleMesh mesh;
    mesh.name = "plane";
    mesh.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return one_mesh(std::move(mesh));
}

/// A tube about a (2, 3) torus knot: twice round the z axis, three times round the torus.
Model make_knot() {
    constexpr double kRing = 1, kWinding = 0.5, kTube = 0.26;
    const auto curve = [](double t) {
        const double rho = kRing + kWinding * std::cos(3 * t);
        return Vec3{rho * std::cos(2 * t), rho * std::sin(2 * t), kWinding * std::sin(3 * t)};
    };
    // Its frame: along the curve, out of the torus on which it lies, and across both. It closes
    // without a twist to be taken out.
    const auto tube = [&](double u, double v) {
        const double t = 2 * kPi * v, angle = 2 * kPi * u;
        const Vec3 out{std::cos(3 * t) * std::cos(2 * t), std::cos(3 * t) * std::sin(2 * t),
                       std::sin(3 * t)};
        const double rho = kRing + kWinding * std::cos(3 * t);
        const double d_rho = -3 * kWinding * std::sin(3 * t);
        const Vec3 along = normalize({d_rho * std::cos(2 * t) - 2 * rho * std::sin(2 * t),
                                      d_rho * std::sin(2 * t) + 2 * rho * std::cos(2 * t),
                                      3 * kWinding * std::cos(3 * t)});
        const Vec3 across = cross(along, out);
        const Vec3 normal = std::cos(angle) * out - std::sin(angle) * across;
        return SweptVertex{curve(t) + kTube * normal, normal};
    };
    Model model = one_mesh(detail::sweep("knot", {96, 960, SweepEnds::Join}, tube));
    fit_to_unit_sphere(model);
    return model;
}

/// Distance of the preview ball's skin from its centre, at an angle from its axis: a sphere with a
/// round recess that bares a smaller sphere, and a ring laid into a groove round that.
double ball_radius(double angle) {
    const double from_ring = std::abs(angle - radians(66));
    const double recess = 0.2 * (1 - smooth_step(radians(24), radians(33), angle));
    const double groove = 0.1 * (1 - smooth_step(radians(7.5), radians(10.5), from_ring));
    const double ring = 0.1 * (1 - smooth_step(radians(2.5), radians(5.5), from_ring));
    return 1 - recess - groove + ring;
}

TriangleMesh make_ball_body() {
    constexpr int kRows = 720, kColumns = 360;
    constexpr double kStep = 1e-5;
    std::vector<detail::ProfilePoint> profile;
    for (int j = 0; j <= kRows; ++j) {
        const double angle = kPi * j / kRows;
        const double radius = ball_radius(angle);
        const double slope =
            (ball_radius(angle + kStep) - ball_radius(angle - kStep)) / (2 * kStep);
        // sin(pi) is not quite 0, but a pole lies on the axis.
        const double s = std::sin(std::min(angle, kPi - angle)), c = std::cos(angle);
        const double size = std::hypot(radius, slope);
        profile.push_back({radius * s, radius * c, (radius * s - slope * c) / size,
                           (radius * c + slope * s) / size});
    }
    return detail::lathe("ball", profile, kColumns);
}

Model make_ball() {
    constexpr int kColumns = 256;
    const std::vector<detail::ProfileCorner> foot{{0, -0.85, 0},       {0.4, -0.85, 0.02},
                                                  {0.4, -1.02, 0.1},   {0.56, -1.1, 0.03},
                                                  {0.56, -1.16, 0.02}, {0, -1.16, 0}};
    const std::vector<detail::ProfileCorner> dish{{0, -1.161, 0},       {0.92, -1.161, 0.12},
                                                  {1.07, -1.06, 0.012}, {1.1, -1.06, 0.012},
                                                  {1.0, -1.21, 0.03},   {0, -1.21, 0}};
    Model model;
    model.meshes.push_back(make_ball_body());
    model.meshes.push_back(detail::lathe("foot", detail::rounded_profile(foot), kColumns));
    model.meshes.push_back(detail::lathe("dish", detail::rounded_profile(dish), kColumns));
    model.instances = {
        {0, leaning(44), Role::Subject}, {1, {}, Role::Subject}, {2, {}, Role::Stage}};
    fit_to_unit_sphere(model);
    return model;
}

// The bowl: a shell of this radius and thickness, open above; v runs up the inside, over the round
// rim, and down the outside.
constexpr double kShell = 0.9, kHalfThickness = 0.03, kRim = radians(98);
constexpr double kInsideEnds = 0.46, kOutsideStarts = 0.54;

/// A point of the plain shell, before its rim is waved: distance r from the y axis, height y.
Vec3 plain_bowl(double u, double v) {
    double angle = kRim, radius = kShell, rim_angle = 0;
    if (v < kInsideEnds) {
        angle = kRim * v / kInsideEnds;
        radius = kShell - kHalfThickness;
    } else if (v > kOutsideStarts) {
        angle = kRim * (1 - v) / (1 - kOutsideStarts);
        radius = kShell + kHalfThickness;
    } else {
        rim_angle = kPi * (v - kInsideEnds) / (kOutsideStarts - kInsideEnds);
        radius = kShell - kHalfThickness * std::cos(rim_angle);
    }
    const double forth = kHalfThickness * std::sin(rim_angle);
    const double r = radius * std::sin(angle) + forth * std::cos(angle);
    const double y = -radius * std::cos(angle) + forth * std::sin(angle);
    return {r * std::sin(2 * kPi * u), y, r * std::cos(2 * kPi * u)};
}

/// Folds the shell into petals that grow towards the rim and turn about the axis.
Vec3 fold(Vec3 p) {
    constexpr int kPetals = 9;
    constexpr double kHeight = 0.085, kTurn = 2.2;
    const double from_below = std::atan2(std::hypot(p.x, p.z), -p.y);
    const double azimuth = std::atan2(p.x, p.z);
    const double share = smooth_step(radians(28), radians(115), from_below);
    return (1 + kHeight * share * std::cos(kPetals * azimuth + kTurn * from_below)) * p;
}

SweptVertex bowl_vertex(double u, double v) {
    if (v <= 0) return {plain_bowl(0, 0), {0, 1, 0}};
    if (v >= 1) return {plain_bowl(0, 1), {0, -1, 0}};
    constexpr double kStep = 1e-6;
    const auto point = [](double a, double b) { return fold(plain_bowl(a, b)); };
    const Vec3 across = point(u + kStep, v) - point(u - kStep, v);
    const Vec3 down = point(u, v + kStep) - point(u, v - kStep);
    return {point(u, v), normalize(cross(down, across))};
}

Model make_bowl() {
    constexpr double kPearl = 0.27;
    Model model;
    model.meshes.push_back(detail::sweep("bowl", {540, 400, SweepEnds::Poles}, bowl_vertex));
    model.meshes.push_back(make_sphere(256, 128));
    model.meshes.back().name = "pearl";
    // It has rolled to where the leaning bowl is lowest.
    const double depth = kShell - kHalfThickness - kPearl - 1e-3;
    model.instances = {{0, leaning(42), Role::Subject},
                       {1, scaled(kPearl, {0, -depth, 0}), Role::Subject}};
    fit_to_unit_sphere(model);
    return model;
}

/// A built-in model and how it is made.
struct Recipe {
    const char* name;
    const char* description;
    Model (*make)();
};

constexpr Recipe kRecipes[] = {
    {"sphere", "sphere with exact normals", [] { return one_mesh(make_sphere(512, 256)); }},
    {"plane", "level square", make_plane},
    {"knot", "torus knot (2, 3)", make_knot},
    {"ball", "material preview: ball with a recess and a ring, on a dish", make_ball},
    {"bowl", "folded bowl that holds a pearl: light is reflected to and fro", make_bowl},
};

const Recipe* find_recipe(const std::string& name) {
    const auto* const found = std::find_if(std::begin(kRecipes), std::end(kRecipes),
                                           [&](const Recipe& r) { return name == r.name; });
    return found == std::end(kRecipes) ? nullptr : found;
}

void check_side(int value, int least, const char* where) {
    if (value < least || value > kMostOnASide)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is outside {} .. {}", value, least, kMostOnASide), where);
}

}  // namespace

std::vector<BuiltinModel> builtin_models() {
    std::vector<BuiltinModel> models;
    for (const Recipe& recipe : kRecipes) models.push_back({recipe.name, recipe.description});
    return models;
}

bool is_builtin_model(const std::string& name) {
    return find_recipe(name) != nullptr;
}

Model make_builtin_model(const std::string& name) {
    const Recipe* const recipe = find_recipe(name);
    if (recipe == nullptr) {
        std::string names;
        for (const Recipe& r : kRecipes) names += (names.empty() ? "" : ", ") + std::string(r.name);
        throw Error(ErrorCode::Usage,
                    fmt::format("there is no built-in model '{}'; there are {}", name, names),
                    "model");
    }
    Model model = recipe->make();
    model.name = recipe->name;
    return model;
}

TriangleMesh make_sphere(int slices, int stacks) {
    check_side(slices, 3, "slices");
    check_side(stacks, 2, "stacks");
    return detail::sweep("sphere", {slices, stacks, SweepEnds::Poles}, [](double u, double v) {
        const double around = 2 * kPi * u;
        // Exactly 0 at both poles.
        const double s = std::sin(kPi * std::min(v, 1 - v));
        const Vec3 p{s * std::sin(around), std::cos(kPi * v), s * std::cos(around)};
        return SweptVertex{p, p};
    });
}

void add_floor(Model& model, double radius) {
    if (!(radius > 0) || !std::isfinite(radius))
        throw Error(ErrorCode::Usage, fmt::format("{} is not above 0", radius), "radius");
    constexpr std::uint32_t kCorners = 360;
    // A hair below: a model with a flat bottom must not share its plane.
    constexpr double kGap = 1e-4;
    const Bounds box = bounds(model);
    const double height = box.empty() ? 0 : box.low.y - kGap * (box.high.y - box.low.y + radius);

    TriangleMesh mesh;
    mesh.name = "floor";
    mesh.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < kCorners; ++i) {
        const double angle = 2 * kPi * i / kCorners;
        mesh.positions.push_back(
            {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))});
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kCorners});
    }
    mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
    const Vec3 centre = box.empty() ? Vec3{} : box.centre();
    model.instances.push_back({static_cast<std::uint32_t>(model.meshes.size()),
                               scaled(radius, {centre.x, height, centre.z}), Role::Stage});
    model.meshes.push_back(std::move(mesh));
}

}  // namespace asperity
