// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, .gltf and .glb: the triangles of its meshes, put into the world by the nodes of the
// scene that is shown first.
#include <asperity/formats/models/gltf_document.h>
#include <asperity/formats/models/gltf_transform.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

using Json = GltfDocument::Json;

constexpr std::uint64_t kTriangles = 4, kFan = 6;  // primitive modes; a strip is 5

// Primitives may share indices and vertices, of which each gets its own copy: up to a point.
constexpr std::uint64_t kFreeCorners = 1 << 22, kMostCornersAByte = 4;

class GltfReader {
  public:
    explicit GltfReader(ModelSource& source) : source_(source), document_(source) {}

    Model read() {
        for (const Json& mesh : document_.list(document_.root(), "meshes")) add_mesh(mesh);
        visited_.assign(document_.entries("nodes"), false);
        for (const std::uint64_t root : scene_roots()) visit(root, {}, 1);
        if (is_morphed_) source_.remarks.push_back("its morph targets are not applied");
        if (is_skinned_) source_.remarks.push_back("its skin is not bent: it is shown at rest");
        return std::move(model_);
    }

  private:
    // Meshes

    /// A glTF mesh is several of ours, one a primitive.
    struct Part {
        std::size_t first = 0, end = 0;  ///< in the model's meshes
        std::uint64_t triangles = 0;
    };

    void add_mesh(const Json& in) {
        const Json* const name = GltfDocument::find(in, "name");
        Part part{model_.meshes.size(), 0, 0};
        look_at_weights(in);
        for (const Json& primitive : document_.list(in, "primitives")) {
            TriangleMesh mesh = read_primitive(primitive);
            if (mesh.triangles.empty()) continue;
            if (name && name->is_string()) mesh.name = name->get<std::string>();
            part.triangles += mesh.triangles.size();
            model_.meshes.push_back(std::move(mesh));
            check_limit(model_.meshes.size(), source_.limits.meshes, "meshes");
        }
        part.end = model_.meshes.size();
        parts_.push_back(part);
    }

    /// Of morph targets, by which a mesh or its node would be changed.
    void look_at_weights(const Json& in) {
        for (const Json& weight : document_.list(in, "weights"))
            is_morphed_ = is_morphed_ || weight != 0;
    }

    /// Without triangles when it has none.
    TriangleMesh read_primitive(const Json& primitive) {
        const std::uint64_t mode = document_.whole(primitive, "mode", kTriangles);
        if (mode > kFan) document_.fail(fmt::format("{} is not a mode of primitives", mode));
        if (mode < kTriangles) return {};  // points or lines
        const Json* const attributes = GltfDocument::find(primitive, "attributes");
        if (!attributes) document_.fail("a primitive without attributes");
        const auto position = document_.optional_whole(*attributes, "POSITION");
        if (!position) return {};
        const GltfAccessor positions = document_.vectors(*position);
        GltfAccessor normals;
        if (const auto normal = document_.optional_whole(*attributes, "NORMAL")) {
            normals = document_.vectors(*normal);
            if (normals.count != positions.count)
                document_.fail(
                    fmt::format("{} normals for {} vertices", normals.count, positions.count));
        }
        std::vector<std::uint32_t> corners = read_corners(primitive, positions.count);
        TriangleMesh mesh;
        mesh.triangles = triangles_of(mode, take_vertices(corners, positions, normals, mesh));
        return mesh;
    }

    /// The vertex at each corner.
    std::vector<std::uint32_t> read_corners(const Json& primitive, std::uint64_t vertices) {
        const auto index = document_.optional_whole(primitive, "indices");
        const GltfAccessor list = index ? document_.indices(*index) : GltfAccessor{};
        const std::uint64_t count = index ? list.count : vertices;
        corners_ += count;
        if (corners_ > kFreeCorners + kMostCornersAByte * document_.bytes_read())
            document_.fail(fmt::format("{} corners of triangles do not come out of {} bytes",
                                       corners_, document_.bytes_read()));
        if (count > std::numeric_limits<std::uint32_t>::max())
            document_.fail("more vertices than 32 bits can count");
        std::vector<std::uint32_t> corners(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            corners[i] = index ? list.index_at(i) : static_cast<std::uint32_t>(i);
            if (corners[i] >= vertices)
                document_.fail(fmt::format("index {} refers to vertex {}, the primitive has {}", i,
                                           corners[i], vertices));
        }
        return corners;
    }

    /// Moves the vertices that are used into the mesh, in the order of the file: many primitives
    /// may share a large list of them. Returns the corners in the mesh's own numbers.
    static std::vector<std::uint32_t> take_vertices(const std::vector<std::uint32_t>& corners,
                                                    const GltfAccessor& positions,
                                                    const GltfAccessor& normals,
                                                    TriangleMesh& mesh) {
        std::vector<std::uint32_t> used = corners;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (const std::uint32_t v : used) {
            mesh.positions.push_back(positions.vector_at(v));
            if (normals.count > 0) mesh.normals.push_back(normals.vector_at(v));
        }
        std::vector<std::uint32_t> own;
        own.reserve(corners.size());
        for (const std::uint32_t v : corners) {
            const auto place = std::lower_bound(used.begin(), used.end(), v);
            own.push_back(static_cast<std::uint32_t>(place - used.begin()));
        }
        return own;
    }

    std::vector<std::array<std::uint32_t, 3>> triangles_of(std::uint64_t mode,
                                                           const std::vector<std::uint32_t>& c) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        if (mode == kTriangles) {
            for (std::size_t i = 0; i + 2 < c.size(); i += 3)
                triangles.push_back({c[i], c[i + 1], c[i + 2]});
        }
        for (std::size_t i = 0; mode != kTriangles && i + 2 < c.size(); ++i) {
            if (mode == kFan)
                triangles.push_back({c[0], c[i + 1], c[i + 2]});
            else  // every second triangle of a strip turns the other way
                triangles.push_back({c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]});
        }
        unique_triangles_ += triangles.size();
        check_limit(unique_triangles_, source_.limits.triangles, "triangles");
        return triangles;
    }

    // Nodes

    /// Of the scene shown first, or of all nodes when there is none.
    std::vector<std::uint64_t> scene_roots() {
        if (document_.entries("scenes") > 0) {
            const auto scene = document_.whole(document_.root(), "scene", 0);
            return document_.wholes(document_.entry("scenes", scene), "nodes");
        }
        std::vector<bool> is_child(document_.entries("nodes"), false);
        for (const Json& node : document_.list(document_.root(), "nodes")) {
            for (const std::uint64_t child : document_.wholes(node, "children")) {
                if (child < is_child.size()) is_child[child] = true;
            }
        }
        std::vector<std::uint64_t> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) roots.push_back(i);
        }
        return roots;
    }

    void visit(std::uint64_t index, const Transform& parent, int depth) {
        const Json& node = document_.entry("nodes", index);
        if (visited_[index])
            document_.fail(fmt::format("node {} stands in the scene twice", index));
        visited_[index] = true;
        if (depth > source_.limits.nodes_deep)
            document_.fail(fmt::format("nodes more than {} deep", source_.limits.nodes_deep));
        const Transform to_world = combined(parent, transform_of(document_, node));
        look_at_weights(node);
        is_skinned_ = is_skinned_ || GltfDocument::find(node, "skin");
        if (const auto mesh = document_.optional_whole(node, "mesh"))
            add_instances(*mesh, to_world);
        for (const std::uint64_t child : document_.wholes(node, "children"))
            visit(child, to_world, depth + 1);
    }

    void add_instances(std::uint64_t mesh, const Transform& to_world) {
        if (mesh >= parts_.size())
            document_.fail(
                fmt::format("a node refers to mesh {}, there are {}", mesh, parts_.size()));
        const Part& part = parts_[mesh];
        instanced_triangles_ += part.triangles;
        check_limit(instanced_triangles_, source_.limits.triangles, "triangles");
        check_limit(model_.instances.size() + (part.end - part.first), source_.limits.instances,
                    "instances");
        for (std::size_t m = part.first; m < part.end; ++m)
            model_.instances.push_back({static_cast<std::uint32_t>(m), to_world, Role::Subject});
    }

    void check_limit(std::uint64_t count, std::uint64_t most, const char* what) const {
        if (count > most) document_.fail(fmt::format("more than {} {}", most, what));
    }

    ModelSource& source_;
    GltfDocument document_;
    Model model_;
    std::vector<Part> parts_;
    std::vector<bool> visited_;
    bool is_morphed_ = false, is_skinned_ = false;
    std::uint64_t unique_triangles_ = 0, instanced_triangles_ = 0, corners_ = 0;
};

Model read_gltf(ModelSource& source) {
    return GltfReader(source).read();
}

/// A .glb, or JSON: no other format of models starts with a brace.
bool is_gltf(const FileStart& start) {
    std::string_view text = start.bytes;
    if (text.starts_with("glTF")) return true;
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

ModelFormat gltf_format() {
    return {"glTF", {".gltf", ".glb"}, is_gltf, read_gltf};
}

}  // namespace asperity::io::detail
