// SPDX-License-Identifier: Apache-2.0
// What the readers of model formats share.
#include <asperity/core/error.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace asperity::io::detail {

void add_mesh(Model& model, TriangleMesh mesh, Vec3 origin) {
    Transform to_world;
    to_world.origin = origin;
    model.instances.push_back(
        {static_cast<std::uint32_t>(model.meshes.size()), to_world, Role::Subject});
    model.meshes.push_back(std::move(mesh));
}

void check_limits(const Model& model, const ModelSource& source) {
    const ModelLimits& limits = source.limits;
    const ModelStatistics s = statistics(model);
    const auto check = [&](std::uint64_t count, std::uint64_t most, const char* what) {
        if (count > most)
            throw Error(ErrorCode::InvalidInput, fmt::format("more than {} {}", most, what),
                        source.path);
    };
    check(s.meshes, limits.meshes, "meshes");
    check(s.instances, limits.instances, "instances");
    check(s.unique_triangles, limits.triangles, "triangles");
    check(s.instanced_triangles, limits.triangles, "triangles");
}

void fail_at_line(const std::string& path, std::uint64_t line, std::string why) {
    throw Error(ErrorCode::InvalidInput, std::move(why), fmt::format("{}:{}", path, line));
}

void fail_at_byte(const std::string& path, std::uint64_t byte, std::string why) {
    throw Error(ErrorCode::InvalidInput, std::move(why), fmt::format("{}:{}", path, byte));
}

void join_equal_vertices(TriangleMesh& mesh) {
    const auto bits = [](Vec3f v) {
        // 0 and -0 are one place.
        const auto word = [](float x) { return std::bit_cast<std::uint32_t>(x == 0 ? 0.0f : x); };
        return std::tuple(word(v.x), word(v.y), word(v.z));
    };
    const auto key = [&](std::uint32_t v) {
        return std::tuple(bits(mesh.positions[v]),
                          mesh.normals.empty() ? bits({}) : bits(mesh.normals[v]));
    };
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(key(a), a) < std::tuple(key(b), b);
    });
    // The first vertex of each run of equal ones stands for all.
    std::vector<std::uint32_t> first(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    // Those close ranks in the order of the file.
    std::vector<std::uint32_t> place(order.size());
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < first.size(); ++v) {
        if (first[v] != v) continue;
        mesh.positions[kept] = mesh.positions[v];
        if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[v];
        place[v] = kept++;
    }
    mesh.positions.resize(kept);
    if (!mesh.normals.empty()) mesh.normals.resize(kept);
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& v : triangle) v = place[first[v]];
    }
}

}  // namespace asperity::io::detail
