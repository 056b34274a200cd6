// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/smoothing_groups.h>

#include <asperity/formats/models/model_formats.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

constexpr std::size_t kMostSets = 64;

/// A corner of a triangle, and the groups of that.
struct Corner {
    std::uint32_t vertex = 0, groups = 0, triangle = 0, corner = 0;
};

/// Facets at a vertex that are in the same groups.
struct Set {
    std::uint32_t groups = 0;
    Vec3 area;  ///< sum, along the normal
};

Vec3 area_of(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& t = mesh.triangles[triangle];
    const Vec3 a = to_double(mesh.positions[t[0]]);
    const Vec3 n = cross(to_double(mesh.positions[t[1]]) - a, to_double(mesh.positions[t[2]]) - a);
    return std::isfinite(dot(n, n)) ? n : Vec3{};
}

/// What is no direction stays zero; drop_undrawable replaces it.
Vec3f unit(Vec3 v) {
    const double size = length(v);
    if (!(size > 0)) return {};
    return {static_cast<float>(v.x / size), static_cast<float>(v.y / size),
            static_cast<float>(v.z / size)};
}

std::vector<Corner> sorted_corners(const TriangleMesh& mesh,
                                   std::span<const std::uint32_t> groups) {
    std::vector<Corner> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k)
            corners.push_back({mesh.triangles[t][k], groups[t], t, k});
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
        return std::tuple(a.vertex, a.groups, a.triangle, a.corner) <
               std::tuple(b.vertex, b.groups, b.triangle, b.corner);
    });
    return corners;
}

/// The sets of the corners of one vertex, which are sorted by groups.
std::vector<Set> sets_of(const TriangleMesh& mesh, std::span<const Corner> corners) {
    std::vector<Set> sets;
    for (const Corner& corner : corners) {
        if (sets.empty() || sets.back().groups != corner.groups)
            sets.push_back({corner.groups, {}});
        sets.back().area = sets.back().area + area_of(mesh, corner.triangle);
    }
    return sets;
}

Vec3 normal_of(const Set& set, const std::vector<Set>& sets) {
    if (sets.size() > kMostSets) return set.area;
    Vec3 sum;
    for (const Set& other : sets) {
        if ((other.groups & set.groups) != 0) sum = sum + other.area;
    }
    return sum;
}

}  // namespace

void apply_smoothing_groups(TriangleMesh& mesh, std::span<const std::uint32_t> groups) {
    const std::vector<Corner> corners = sorted_corners(mesh, groups);
    const TriangleMesh before = mesh;
    mesh.positions.clear();
    mesh.normals.clear();
    const auto add_vertex = [&](std::uint32_t vertex, Vec3f normal) {
        mesh.positions.push_back(before.positions[vertex]);
        mesh.normals.push_back(normal);
    };
    for (std::size_t begin = 0; begin < corners.size();) {
        std::size_t end = begin;
        while (end < corners.size() && corners[end].vertex == corners[begin].vertex) ++end;
        const std::vector<Set> sets =
            sets_of(before, std::span(corners).subspan(begin, end - begin));
        std::size_t set = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const Corner& corner = corners[k];
            const bool next_set = k > begin && corner.groups != corners[k - 1].groups;
            if (next_set) ++set;
            if (corner.groups == 0)
                add_vertex(corner.vertex, unit(area_of(before, corner.triangle)));
            else if (k == begin || next_set)
                add_vertex(corner.vertex, unit(normal_of(sets[set], sets)));
            mesh.triangles[corner.triangle][corner.corner] =
                static_cast<std::uint32_t>(mesh.positions.size() - 1);
        }
        begin = end;
    }
    join_equal_vertices(mesh);
}

}  // namespace asperity::io::detail
