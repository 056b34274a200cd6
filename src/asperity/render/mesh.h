// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The world of a scene. Right-handed, y up; without a camera of his own a user looks along -z, x to
// the right. Lengths have no unit; fit_to_unit_sphere brings models to one size. It is the thesis'
// world, and the only one of the project that has y up: where a surface is shaded, directions
// are turned into the frame of a Bsdf, z the normal (shading.h).

namespace asperity {

struct Vec3f {
    float x = 0, y = 0, z = 0;
    friend constexpr bool operator==(Vec3f a, Vec3f b) = default;
};

constexpr Vec3 to_double(Vec3f v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// Triangles that share vertices.
struct TriangleMesh {
    std::string name;
    std::vector<Vec3f> positions;
    /// One unit vector a vertex, or none at all: facets are flat then.
    std::vector<Vec3f> normals;
    /// Three vertices, counter-clockwise seen from outside; each < positions.size().
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// p -> x p.x + y p.y + z p.z + origin; the columns need be neither unit nor orthogonal.
struct Transform {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};
    friend constexpr bool operator==(const Transform& a, const Transform& b) = default;

    constexpr Vec3 point(Vec3 p) const { return p.x * x + p.y * y + p.z * z + origin; }
    constexpr Vec3 vector(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

/// What a part of a scene is there for; it decides which material is assigned to it.
enum class Role {
    Subject,  ///< the model that is looked at: the material, or both of a split view
    Stage,    ///< what it stands on: ModelScene::stage
};

/// A mesh put into the world.
struct Instance {
    std::uint32_t mesh = 0;  ///< index into Model::meshes
    Transform to_world;
    Role role = Role::Subject;
};

/// All that can be hit in a scene.
struct Model {
    std::string name;  ///< of the built-in model, or of the file without its folder
    std::vector<TriangleMesh> meshes;
    std::vector<Instance> instances;
};

/// What the thesis' Statistics show of a scene. "Unique" counts every mesh once, "instanced" as
/// often as it stands in the world; a mesh of no instance counts as unique only.
struct ModelStatistics {
    std::uint64_t meshes = 0, instances = 0;
    std::uint64_t unique_triangles = 0, unique_vertices = 0;
    std::uint64_t instanced_triangles = 0, instanced_vertices = 0;
    friend bool operator==(const ModelStatistics& a, const ModelStatistics& b) = default;
};
ModelStatistics statistics(const Model& model);

/// An upright box; empty when low > high.
struct Bounds {
    Vec3 low{1, 1, 1}, high{-1, -1, -1};
    constexpr bool empty() const { return low.x > high.x; }
    constexpr Vec3 centre() const { return 0.5 * (low + high); }
};
/// Of all instances, in the world. Vertices that no triangle uses do not count.
Bounds bounds(const Model& model);

/// Moves the centre of bounds() to the origin and scales evenly so that the farthest vertex from it
/// lies at distance 1. Only the instances change. A model without extent is only moved.
void fit_to_unit_sphere(Model& model);

/// Where the normals of a mesh come from.
enum class NormalStyle {
    AsGiven,  ///< those of the mesh, smooth where it has none
    Smooth,   ///< mean of the facets round a vertex, weighted by their angles there
    Facet,    ///< flat facets
};

/// Gives the mesh normals of that style. Smooth: facets that meet at more than `crease_deg` at a
/// vertex keep an edge (the vertex is doubled), 0 .. 180, 180 = never an edge; vertices at one
/// place count as one; facets without area have no say; a normal that comes out as zero is the
/// facet's own.
void set_normals(TriangleMesh& mesh, NormalStyle style, double crease_deg = 180);

/// Takes out what cannot be drawn: triangles with a vertex that is not finite, or without area.
/// Returns how many. Given normals that are not unit vectors are scaled, or replaced by the facet's
/// where that is impossible.
std::uint64_t drop_undrawable(TriangleMesh& mesh);

/// Throws Error(InvalidInput, model.name) unless all indices lie in range, normals are none or one
/// a vertex, and every transform and every vertex in use is finite.
void check(const Model& model);

}  // namespace asperity
