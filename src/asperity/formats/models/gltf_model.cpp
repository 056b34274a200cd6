// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, .gltf and .glb. The walk writes a scene that holds the triangles of the file and
// nothing else, every index, length and offset in it checked; assimp reads that.
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/assimp_import.h>
#include <asperity/formats/models/gltf_buffers.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io::detail {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;
constexpr std::uint64_t kTriangles = 4, kFan = 6;  // primitive modes: list, (strip,) fan
constexpr std::uint64_t kPositionBytes = 12;

// Primitives may share vertices and indices, of which assimp makes copies: up to a point.
constexpr std::uint64_t kFreeEntries = 1 << 22, kMostEntriesAByte = 64;

/// Extensions that a file may require: they change how it looks, not where its triangles are.
constexpr std::array<std::string_view, 5> kHarmless = {
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "EXT_lights_"};

/// A stretch of a buffer that holds `count` equal values, `stride` bytes apart.
struct Accessor {
    std::uint64_t buffer = 0, offset = 0, stride = 0, count = 0, component = 0;
    bool has_stride = false;
};

class Walk {
  public:
    explicit Walk(const ModelSource& source) : source_(source), container_(open_gltf(source)) {}

    std::vector<MemoryFile> clean_files() {
        parse();
        check_version();
        out_ = {{"asset", {{"version", "2.0"}}}, {"meshes", Json::array()}};
        for (const Json& mesh : list(in_, "meshes")) add_mesh(mesh);
        add_scene();
        return files();
    }

  private:
    // The document

    void parse() {
        try {
            in_ = Json::parse(container_.json);
        } catch (const Json::parse_error& error) {
            fail_at_byte(source_.path, container_.json_start + error.byte, "not JSON from here on");
        } catch (const Json::exception&) {
            fail("its JSON holds a number that is too large");
        }
        if (!in_.is_object()) fail("its JSON is not an object");
    }

    void check_version() const {
        const Json* const asset = find(in_, "asset");
        const Json* const version = asset ? find(*asset, "version") : nullptr;
        if (!version || !version->is_string()) fail("there is no asset.version");
        if (!version->get_ref<const std::string&>().starts_with("2."))
            fail(fmt::format("glTF version {}, only 2 is read",
                             in_quotes(version->get_ref<const std::string&>())));
        for (const Json& extension : list(in_, "extensionsRequired")) {
            const std::string name = extension.is_string() ? extension.get<std::string>() : "";
            const bool harmless = std::any_of(kHarmless.begin(), kHarmless.end(),
                                              [&](auto start) { return name.starts_with(start); });
            if (!harmless)
                fail(fmt::format("it needs extension {}, which is not read", in_quotes(name)));
        }
    }

    // Meshes

    void add_mesh(const Json& mesh) {
        Json primitives = Json::array();
        std::uint64_t triangles = 0;
        for (const Json& primitive : list(mesh, "primitives")) {
            const std::uint64_t here = add_primitive(primitive, primitives);
            triangles += here;
            unique_triangles_ += here;
            check_limit(unique_triangles_, source_.limits.triangles, "triangles");
        }
        mesh_triangles_.push_back(triangles);
        mesh_primitives_.push_back(primitives.size());
        new_mesh_.push_back(out_["meshes"].size());
        if (primitives.empty()) return;
        primitives_ += primitives.size();
        check_limit(primitives_, source_.limits.meshes, "meshes");
        out_["meshes"].push_back({{"primitives", std::move(primitives)}});
        const Json* const name = find(mesh, "name");
        if (name && name->is_string()) out_["meshes"].back()["name"] = *name;
    }

    /// Adds it to `primitives` unless it has no triangles; returns how many it has.
    std::uint64_t add_primitive(const Json& primitive, Json& primitives) {
        const std::uint64_t mode = whole(primitive, "mode", kTriangles);
        if (mode > kFan) fail(fmt::format("{} is not a mode of primitives", mode));
        if (mode < kTriangles) return 0;  // points or lines
        const Json* const attributes = find(primitive, "attributes");
        if (!attributes) fail("a primitive without attributes");
        const auto position = optional_whole(*attributes, "POSITION");
        if (!position) return 0;
        const Accessor positions = accessor(*position, "VEC3", kFloat);
        Json clean = {{"mode", mode}, {"attributes", {{"POSITION", emit(positions, "VEC3")}}}};
        if (const auto normal = optional_whole(*attributes, "NORMAL")) {
            const Accessor normals = accessor(*normal, "VEC3", kFloat);
            if (normals.count != positions.count)
                fail(fmt::format("{} normals for {} vertices", normals.count, positions.count));
            clean["attributes"]["NORMAL"] = emit(normals, "VEC3");
        }
        std::uint64_t corners = positions.count;
        if (const auto indices = optional_whole(primitive, "indices")) {
            const Accessor list = accessor(*indices, "SCALAR", 0);
            check_indices(list, positions.count);
            clean["indices"] = emit(list, "SCALAR");
            corners = list.count;
        }
        if (corners < 3) return 0;
        entries_ += positions.count + corners;
        check_amplification();
        primitives.push_back(std::move(clean));
        return mode == kTriangles ? corners / 3 : corners - 2;
    }

    void check_amplification() const {
        std::uint64_t bytes = 0;
        for (const auto& buffer : buffers_) bytes += buffer ? buffer->size() : 0;
        if (entries_ > kFreeEntries + kMostEntriesAByte * bytes)
            fail(fmt::format("{} vertices and indices do not come out of {} bytes", entries_,
                             bytes));
    }

    // Data

    /// The accessor when all of it lies in its buffer. `component` 0: of indices.
    Accessor accessor(std::uint64_t index, std::string_view type, std::uint64_t component) {
        const Json& in = entry("accessors", index);
        if (find(in, "sparse")) fail("sparse accessors are not read");
        Accessor a;
        a.component = whole(in, "componentType", 0);
        const bool fits = component != 0 ? a.component == component
                                         : a.component == kUint8 || a.component == kUint16 ||
                                               a.component == kUint32;
        const Json* const its_type = find(in, "type");
        if (!fits || !its_type || *its_type != type)
            fail(fmt::format("accessor {} has the wrong type for its use", index));
        a.count = whole(in, "count", 0);
        if (a.count == 0) fail(fmt::format("accessor {} is empty", index));
        const auto view_index = optional_whole(in, "bufferView");
        if (!view_index) fail(fmt::format("accessor {} has no bufferView", index));
        const Json& view = entry("bufferViews", *view_index);
        const std::uint64_t size = component == kFloat ? kPositionBytes : index_bytes(a.component);
        a.buffer = whole(view, "buffer", entries("buffers"));
        a.stride = whole(view, "byteStride", size);
        a.has_stride = a.stride != size;
        const std::uint64_t view_offset = whole(view, "byteOffset", 0);
        const std::uint64_t view_length = whole(view, "byteLength", 0);
        const std::uint64_t offset = whole(in, "byteOffset", 0);
        const std::uint64_t there = buffer(a.buffer).size();
        if (view_offset > there || view_length > there - view_offset)
            fail(fmt::format("bufferView {} does not lie in its buffer of {} bytes", *view_index,
                             there));
        if (a.stride < size || a.stride > 255 || (component == 0 && a.has_stride))
            fail(fmt::format("bufferView {} has a stride of {} bytes", *view_index, a.stride));
        if (offset > view_length || view_length - offset < size ||
            a.count - 1 > (view_length - offset - size) / a.stride)
            fail(fmt::format("accessor {} does not lie in its bufferView of {} bytes", index,
                             view_length));
        a.offset = view_offset + offset;
        return a;
    }

    static std::uint64_t index_bytes(std::uint64_t component) {
        return component == kUint8 ? 1 : component == kUint16 ? 2 : 4;
    }

    void check_indices(const Accessor& list, std::uint64_t vertices) {
        const std::string& bytes = buffer(list.buffer);
        const std::uint64_t size = index_bytes(list.component);
        for (std::uint64_t i = 0; i < list.count; ++i) {
            std::uint32_t index = 0;  // little-endian, as the file
            std::memcpy(&index, bytes.data() + list.offset + i * size, size);
            if (index >= vertices)
                fail(fmt::format("index {} refers to vertex {}, the primitive has {}", i, index,
                                 vertices));
        }
    }

    /// Adds it to the clean scene, with a bufferView of its own; returns its new index.
    std::uint64_t emit(const Accessor& a, const char* type) {
        const std::uint64_t size =
            a.component == kFloat ? kPositionBytes : index_bytes(a.component);
        Json view = {{"buffer", a.buffer},
                     {"byteOffset", a.offset},
                     {"byteLength", (a.count - 1) * a.stride + size}};
        if (a.has_stride) view["byteStride"] = a.stride;
        out_["bufferViews"].push_back(std::move(view));
        out_["accessors"].push_back({{"bufferView", out_["bufferViews"].size() - 1},
                                     {"byteOffset", 0},
                                     {"componentType", a.component},
                                     {"count", a.count},
                                     {"type", type}});
        return out_["accessors"].size() - 1;
    }

    const std::string& buffer(std::uint64_t index) {
        const Json& in = entry("buffers", index);
        buffers_.resize(entries("buffers"));
        auto& bytes = buffers_[index];
        if (bytes) return *bytes;
        const Json* const uri = find(in, "uri");
        if (uri && uri->is_string())
            bytes = read_gltf_uri(uri->get_ref<const std::string&>(), source_);
        else if (index == 0 && container_.binary)
            bytes = *container_.binary;
        else
            fail(fmt::format("buffer {} has no uri", index));
        const std::uint64_t announced = whole(in, "byteLength", 0);
        if (announced > bytes->size())
            fail(fmt::format("buffer {} announces {} bytes, it has {}", index, announced,
                             bytes->size()));
        return *bytes;
    }

    // Nodes

    /// The nodes of the scene shown first, or of all when there is none.
    void add_scene() {
        out_["nodes"] = Json::array();
        const std::size_t nodes = entries("nodes");
        for (std::size_t i = 0; i < nodes; ++i) out_["nodes"].push_back(Json::object());
        visited_.assign(nodes, false);
        Json roots = Json::array();
        for (const std::uint64_t root : scene_roots()) {
            visit(root, 1);
            roots.push_back(root);
        }
        out_["scenes"] = Json::array({Json{{"nodes", std::move(roots)}}});
        out_["scene"] = 0;
    }

    std::vector<std::uint64_t> scene_roots() {
        if (entries("scenes") > 0) return wholes(entry("scenes", whole(in_, "scene", 0)), "nodes");
        std::vector<bool> is_child(entries("nodes"), false);
        for (const Json& node : list(in_, "nodes")) {
            for (const std::uint64_t child : wholes(node, "children")) {
                if (child < is_child.size()) is_child[child] = true;
            }
        }
        std::vector<std::uint64_t> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) roots.push_back(i);
        }
        return roots;
    }

    void visit(std::uint64_t index, int depth) {
        const Json& in = entry("nodes", index);
        if (visited_[index]) fail(fmt::format("node {} stands in the scene twice", index));
        visited_[index] = true;
        if (depth > source_.limits.nodes_deep)
            fail(fmt::format("nodes more than {} deep", source_.limits.nodes_deep));
        Json& out = out_["nodes"][index];
        for (const auto& [key, size] :
             {std::pair{"matrix", 16u}, {"translation", 3u}, {"rotation", 4u}, {"scale", 3u}}) {
            if (find(in, key)) out[key] = numbers(in, key, size);
        }
        if (const auto mesh = optional_whole(in, "mesh")) add_instance(*mesh, out);
        const std::vector<std::uint64_t> children = wholes(in, "children");
        for (const std::uint64_t child : children) visit(child, depth + 1);
        if (!children.empty()) out_["nodes"][index]["children"] = children;
    }

    void add_instance(std::uint64_t mesh, Json& node) {
        if (mesh >= new_mesh_.size())
            fail(fmt::format("a node refers to mesh {}, there are {}", mesh, new_mesh_.size()));
        if (mesh_primitives_[mesh] == 0) return;
        node["mesh"] = new_mesh_[mesh];
        instances_ += mesh_primitives_[mesh];
        check_limit(instances_, source_.limits.instances, "instances");
        instanced_triangles_ += mesh_triangles_[mesh];
        check_limit(instanced_triangles_, source_.limits.triangles, "triangles");
    }

    // Reading JSON that may be anything

    static const Json* find(const Json& object, const char* key) {
        if (!object.is_object()) return nullptr;
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }

    const Json& list(const Json& object, const char* key) const {
        static const Json kNone = Json::array();
        const Json* const found = find(object, key);
        if (!found) return kNone;
        if (!found->is_array()) fail(fmt::format("{} is not a list", key));
        return *found;
    }

    std::size_t entries(const char* key) const { return list(in_, key).size(); }

    const Json& entry(const char* key, std::uint64_t index) const {
        const Json& all = list(in_, key);
        if (index >= all.size())
            fail(fmt::format("index {} into {}, of which there are {}", index, key, all.size()));
        return all[index];
    }

    std::optional<std::uint64_t> optional_whole(const Json& object, const char* key) const {
        const Json* const found = find(object, key);
        if (!found) return std::nullopt;
        if (!found->is_number_unsigned()) fail(fmt::format("{} is not a whole number", key));
        return found->get<std::uint64_t>();
    }

    std::uint64_t whole(const Json& object, const char* key, std::uint64_t otherwise) const {
        return optional_whole(object, key).value_or(otherwise);
    }

    std::vector<std::uint64_t> wholes(const Json& object, const char* key) const {
        std::vector<std::uint64_t> values;
        for (const Json& value : list(object, key)) {
            if (!value.is_number_unsigned()) fail(fmt::format("{} are not whole numbers", key));
            values.push_back(value.get<std::uint64_t>());
        }
        return values;
    }

    Json numbers(const Json& object, const char* key, std::size_t size) const {
        const Json& values = list(object, key);
        if (values.size() != size ||
            !std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); }))
            fail(fmt::format("a {} needs {} numbers", key, size));
        return values;
    }

    // The clean scene as files

    std::vector<MemoryFile> files() {
        std::vector<MemoryFile> files(1);
        out_["buffers"] = Json::array();
        buffers_.resize(entries("buffers"));
        for (std::size_t i = 0; i < buffers_.size(); ++i) {
            // Those that no triangle needs were not read.
            if (!buffers_[i]) buffers_[i] = std::string(4, '\0');
            const std::string name = fmt::format("{}.bin", i);
            out_["buffers"].push_back({{"byteLength", buffers_[i]->size()}, {"uri", name}});
            files.emplace_back(name, *std::move(buffers_[i]));
        }
        files[0] = {"model.gltf", out_.dump(-1, ' ', false, Json::error_handler_t::replace)};
        return files;
    }

    void check_limit(std::uint64_t count, std::uint64_t most, const char* what) const {
        if (count > most) fail(fmt::format("more than {} {}", most, what));
    }

    [[noreturn]] void fail(std::string why) const {
        throw Error(ErrorCode::InvalidInput, std::move(why), source_.path);
    }

    const ModelSource& source_;
    GltfContainer container_;
    Json in_, out_;
    std::vector<std::optional<std::string>> buffers_;
    std::vector<std::uint64_t> mesh_triangles_, mesh_primitives_, new_mesh_;
    std::vector<bool> visited_;
    std::uint64_t unique_triangles_ = 0, instanced_triangles_ = 0;
    std::uint64_t entries_ = 0, primitives_ = 0, instances_ = 0;
};

}  // namespace

Model read_gltf(ModelSource& source) {
    const std::vector<MemoryFile> files = Walk(source).clean_files();
    return import_with_assimp(files, source.path);
}

}  // namespace asperity::io::detail
