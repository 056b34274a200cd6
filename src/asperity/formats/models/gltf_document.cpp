// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/gltf_document.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::string_view kQuantization = "KHR_mesh_quantization";
constexpr std::array kOfVectors = {GltfComponent::Float, GltfComponent::Int8, GltfComponent::Uint8,
                                   GltfComponent::Int16, GltfComponent::Uint16};
constexpr std::array kOfIndices = {GltfComponent::Uint8, GltfComponent::Uint16,
                                   GltfComponent::Uint32};
constexpr std::uint64_t kMostStride = 255;

/// Extensions that a file may require: they change how it looks, not where its triangles are.
constexpr std::array<std::string_view, 5> kHarmless = {
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "EXT_lights_"};

bool is_one_of(GltfComponent component, std::span<const GltfComponent> components) {
    return std::find(components.begin(), components.end(), component) != components.end();
}

}  // namespace

GltfDocument::GltfDocument(const ModelSource& source) : source_(source), files_(source) {
    GltfContainer container = open_gltf(source);
    parse(container);
    check_version();
    binary_ = std::move(container.binary);
    buffers_.resize(entries("buffers"));
}

void GltfDocument::parse(const GltfContainer& container) {
    try {
        json_ = Json::parse(container.json);
    } catch (const Json::parse_error& error) {
        fail_at_byte(source_.path, container.json_start + error.byte, "not JSON from here on");
    } catch (const Json::exception&) {
        fail("its JSON holds a number that is too large");
    }
    if (!json_.is_object()) fail("its JSON is not an object");
}

void GltfDocument::check_version() const {
    const Json* const asset = find(json_, "asset");
    const Json* const version = asset ? find(*asset, "version") : nullptr;
    if (!version || !version->is_string()) fail("there is no asset.version");
    if (!version->get_ref<const std::string&>().starts_with("2."))
        fail(fmt::format("glTF version {}, only 2 is read",
                         in_quotes(version->get_ref<const std::string&>())));
    for (const Json& extension : list(json_, "extensionsRequired")) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "";
        const bool harmless = std::any_of(kHarmless.begin(), kHarmless.end(),
                                          [&](auto start) { return name.starts_with(start); });
        if (!harmless && name != kQuantization)
            fail(fmt::format("it needs extension {}, which is not read", in_quotes(name)));
    }
}

const GltfDocument::Json* GltfDocument::find(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const GltfDocument::Json& GltfDocument::list(const Json& object, const char* key) const {
    static const Json kNone = Json::array();
    const Json* const found = find(object, key);
    if (!found) return kNone;
    if (!found->is_array()) fail(fmt::format("{} is not a list", key));
    return *found;
}

const GltfDocument::Json& GltfDocument::entry(const char* key, std::uint64_t index) const {
    const Json& all = list(json_, key);
    if (index >= all.size())
        fail(fmt::format("index {} into {}, of which there are {}", index, key, all.size()));
    return all[index];
}

std::optional<std::uint64_t> GltfDocument::optional_whole(const Json& object,
                                                          const char* key) const {
    const Json* const found = find(object, key);
    if (!found) return std::nullopt;
    if (!found->is_number_unsigned()) fail(fmt::format("{} is not a whole number", key));
    return found->get<std::uint64_t>();
}

std::uint64_t GltfDocument::whole(const Json& object, const char* key,
                                  std::uint64_t otherwise) const {
    return optional_whole(object, key).value_or(otherwise);
}

std::vector<std::uint64_t> GltfDocument::wholes(const Json& object, const char* key) const {
    std::vector<std::uint64_t> values;
    for (const Json& value : list(object, key)) {
        if (!value.is_number_unsigned()) fail(fmt::format("{} are not whole numbers", key));
        values.push_back(value.get<std::uint64_t>());
    }
    return values;
}

std::vector<double> GltfDocument::numbers(const Json& object, const char* key,
                                          std::size_t size) const {
    if (!find(object, key)) return {};
    const Json& values = list(object, key);
    if (values.size() != size ||
        !std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); }))
        fail(fmt::format("a {} needs {} numbers", key, size));
    return values.get<std::vector<double>>();
}

bool GltfDocument::uses(std::string_view extension) const {
    const auto is_named = [&](const Json& name) { return name == extension; };
    const Json& used = list(json_, "extensionsUsed");
    const Json& required = list(json_, "extensionsRequired");
    return std::any_of(used.begin(), used.end(), is_named) ||
           std::any_of(required.begin(), required.end(), is_named);
}

GltfAccessor GltfDocument::vectors(std::uint64_t index) {
    const std::span<const GltfComponent> all = kOfVectors;
    return accessor(index, "VEC3", uses(kQuantization) ? all : all.first(1));
}

GltfAccessor GltfDocument::indices(std::uint64_t index) {
    const GltfAccessor a = accessor(index, "SCALAR", kOfIndices);
    if (a.stride != a.size)
        fail(fmt::format("accessor {} of indices has a stride of {} bytes", index, a.stride));
    return a;
}

GltfAccessor GltfDocument::accessor(std::uint64_t index, std::string_view type,
                                    std::span<const GltfComponent> components) {
    const Json& in = entry("accessors", index);
    GltfAccessor a;
    a.component = GltfComponent{whole(in, "componentType", 0)};
    const Json* const its_type = find(in, "type");
    if (!is_one_of(a.component, components) || !its_type || *its_type != type)
        fail(fmt::format("accessor {} has the wrong type for its use", index));
    if (const auto known = accessors_.find(index); known != accessors_.end()) return known->second;
    const Json* const normalized = find(in, "normalized");
    a.normalized = normalized && *normalized == true;
    a.count = whole(in, "count", 0);
    if (a.count == 0) fail(fmt::format("accessor {} is empty", index));
    a.size = (type == "VEC3" ? 3 : 1) * bytes_of(a.component);
    a.stride = a.size;
    const std::string name = fmt::format("accessor {}", index);
    const auto view = optional_whole(in, "bufferView");
    const Json* const sparse = find(in, "sparse");
    if (!view && !sparse) fail(fmt::format("{} has no bufferView", name));
    if (view) {
        a.stride = whole(entry("bufferViews", *view), "byteStride", a.size);
        if (a.stride < a.size || a.stride > kMostStride)
            fail(fmt::format("bufferView {} has a stride of {} bytes", *view, a.stride));
        if (a.count - 1 > (std::numeric_limits<std::uint64_t>::max() - a.size) / a.stride)
            fail(fmt::format("{} has {} values", name, a.count));
        a.bytes =
            stretch(*view, whole(in, "byteOffset", 0), (a.count - 1) * a.stride + a.size, name);
    }
    if (sparse) a.sparse = sparse_list(*sparse, a);
    return accessors_[index] = a;
}

GltfSparse GltfDocument::sparse_list(const Json& in, const GltfAccessor& of) {
    GltfSparse list;
    list.count = whole(in, "count", 0);
    const Json* const indices = find(in, "indices");
    const Json* const values = find(in, "values");
    if (!indices || !values || list.count == 0 || list.count > of.count)
        fail(fmt::format("a sparse list of {} values for {}", list.count, of.count));
    list.place_type = GltfComponent{whole(*indices, "componentType", 0)};
    if (!is_one_of(list.place_type, kOfIndices)) fail("a sparse list whose places have no type");
    const auto packed = [&](const Json& where, std::uint64_t size) {
        if (list.count > std::numeric_limits<std::uint64_t>::max() / size)
            fail(fmt::format("a sparse list of {} values", list.count));
        return stretch(whole(where, "bufferView", entries("bufferViews")),
                       whole(where, "byteOffset", 0), list.count * size, "a sparse list");
    };
    list.places = packed(*indices, bytes_of(list.place_type));
    list.values = packed(*values, of.size);
    for (std::uint64_t k = 0; k < list.count; ++k) {
        const std::uint32_t place = sparse_place(list, k);
        if (place >= of.count || (k > 0 && place <= sparse_place(list, k - 1)))
            fail(fmt::format("place {} of a sparse list is {}, they have to rise up to {}", k,
                             place, of.count - 1));
    }
    return list;
}

std::string_view GltfDocument::stretch(std::uint64_t view_index, std::uint64_t offset,
                                       std::uint64_t bytes, std::string_view whose) {
    const Json& view = entry("bufferViews", view_index);
    const std::string_view there = buffer(whole(view, "buffer", entries("buffers")));
    const std::uint64_t view_offset = whole(view, "byteOffset", 0);
    const std::uint64_t view_length = whole(view, "byteLength", 0);
    if (view_offset > there.size() || view_length > there.size() - view_offset)
        fail(fmt::format("bufferView {} does not lie in its buffer of {} bytes", view_index,
                         there.size()));
    if (offset > view_length || bytes > view_length - offset)
        fail(fmt::format("{} does not lie in its bufferView of {} bytes", whose, view_length));
    return there.substr(view_offset + offset, bytes);
}

std::string_view GltfDocument::buffer(std::uint64_t index) {
    const Json& in = entry("buffers", index);
    auto& bytes = buffers_[index];
    if (bytes) return *bytes;
    const Json* const uri = find(in, "uri");
    std::string_view found;
    if (uri && uri->is_string())
        found = files_.read(uri->get_ref<const std::string&>());
    else if (index == 0 && binary_)
        found = *binary_;
    else
        fail(fmt::format("buffer {} has no uri", index));
    const std::uint64_t announced = whole(in, "byteLength", 0);
    if (announced > found.size())
        fail(
            fmt::format("buffer {} announces {} bytes, it has {}", index, announced, found.size()));
    bytes = found;
    return found;
}

void GltfDocument::fail(std::string why) const {
    throw Error(ErrorCode::InvalidInput, std::move(why), source_.path);
}

}  // namespace asperity::io::detail
