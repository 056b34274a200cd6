// SPDX-License-Identifier: Apache-2.0
#include <asperity/render/mesh.h>

#include <asperity/core/error.h>
#include <asperity/core/finite.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

/// Calls visit(point) with every vertex in use, in the world, once for each triangle that uses it.
template <typename Visit>
void for_each_corner(const Model& model, Visit visit) {
    for (const Instance& instance : model.instances) {
        const TriangleMesh& mesh = model.meshes[instance.mesh];
        for (const auto& triangle : mesh.triangles) {
            for (const std::uint32_t v : triangle)
                visit(instance.to_world.point(to_double(mesh.positions[v])));
        }
    }
}

void extend(Bounds& box, Vec3 p) {
    if (box.empty()) {
        box = {p, p};
        return;
    }
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

/// What is wrong with the mesh; "" when nothing is.
std::string fault_of(const TriangleMesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    if (!mesh.normals.empty() && mesh.normals.size() != vertices)
        return fmt::format("{} normals for {} vertices", mesh.normals.size(), vertices);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) {
            if (v >= vertices)
                return fmt::format("triangle {} refers to vertex {}, there are {}", t, v, vertices);
            if (!is_finite(to_double(mesh.positions[v])))
                return fmt::format("vertex {} is not finite", v);
        }
    }
    return {};
}

}  // namespace

ModelStatistics statistics(const Model& model) {
    ModelStatistics s;
    s.meshes = model.meshes.size();
    s.instances = model.instances.size();
    for (const TriangleMesh& mesh : model.meshes) {
        s.unique_triangles += mesh.triangles.size();
        s.unique_vertices += mesh.positions.size();
    }
    for (const Instance& instance : model.instances) {
        s.instanced_triangles += model.meshes[instance.mesh].triangles.size();
        s.instanced_vertices += model.meshes[instance.mesh].positions.size();
    }
    return s;
}

Bounds bounds(const Model& model) {
    Bounds box;
    for_each_corner(model, [&](Vec3 p) { extend(box, p); });
    return box;
}

void fit_to_unit_sphere(Model& model) {
    const Bounds box = bounds(model);
    if (box.empty()) return;
    const Vec3 centre = box.centre();
    double radius = 0;
    for_each_corner(model, [&](Vec3 p) { radius = std::max(radius, length(p - centre)); });
    const double scale = radius > 0 ? 1 / radius : 1;
    for (Instance& instance : model.instances) {
        Transform& t = instance.to_world;
        t = {scale * t.x, scale * t.y, scale * t.z, scale * (t.origin - centre)};
    }
}

void check(const Model& model) {
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::InvalidInput, why, model.name);
    };
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
        const std::string fault = fault_of(model.meshes[m]);
        if (!fault.empty()) fail(fmt::format("mesh {}: {}", m, fault));
    }
    for (std::size_t i = 0; i < model.instances.size(); ++i) {
        const Instance& instance = model.instances[i];
        if (instance.mesh >= model.meshes.size())
            fail(fmt::format("instance {} is of mesh {}, there are {}", i, instance.mesh,
                             model.meshes.size()));
        const Transform& t = instance.to_world;
        if (!is_finite(t.x) || !is_finite(t.y) || !is_finite(t.z) || !is_finite(t.origin))
            fail(fmt::format("the transform of instance {} is not finite", i));
    }
}

}  // namespace asperity
