// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/gltf_document.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/models/model_formats.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::uint64_t kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;
constexpr std::array kOfVectors = {kFloat};
constexpr std::array kOfIndices = {kUint8, kUint16, kUint32};
constexpr std::uint64_t kMostStride = 255;

/// Extensions that a file may require: they change how it looks, not where its triangles are.
constexpr std::array<std::string_view, 5> kHarmless = {
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "EXT_lights_"};

std::uint64_t bytes_of(std::uint64_t component, std::string_view type) {
    const std::uint64_t one = component == kUint8 ? 1 : component == kUint16 ? 2 : 4;
    return type == "VEC3" ? 3 * one : one;
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
        if (!harmless)
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

GltfDocument::Accessor GltfDocument::vectors(std::uint64_t index) {
    return accessor(index, "VEC3", kOfVectors);
}

GltfDocument::Accessor GltfDocument::indices(std::uint64_t index) {
    const Accessor a = accessor(index, "SCALAR", kOfIndices);
    if (a.stride != a.size)
        fail(fmt::format("accessor {} of indices has a stride of {} bytes", index, a.stride));
    return a;
}

GltfDocument::Accessor GltfDocument::accessor(std::uint64_t index, std::string_view type,
                                              std::span<const std::uint64_t> components) {
    const Json& in = entry("accessors", index);
    if (find(in, "sparse")) fail("sparse accessors are not read");
    const std::uint64_t component = whole(in, "componentType", 0);
    const bool fits =
        std::find(components.begin(), components.end(), component) != components.end();
    const Json* const its_type = find(in, "type");
    if (!fits || !its_type || *its_type != type)
        fail(fmt::format("accessor {} has the wrong type for its use", index));
    Accessor a;
    a.count = whole(in, "count", 0);
    if (a.count == 0) fail(fmt::format("accessor {} is empty", index));
    const auto view_index = optional_whole(in, "bufferView");
    if (!view_index) fail(fmt::format("accessor {} has no bufferView", index));
    const Json& view = entry("bufferViews", *view_index);
    const std::string_view there = buffer(whole(view, "buffer", entries("buffers")));
    const std::uint64_t view_offset = whole(view, "byteOffset", 0);
    const std::uint64_t view_length = whole(view, "byteLength", 0);
    if (view_offset > there.size() || view_length > there.size() - view_offset)
        fail(fmt::format("bufferView {} does not lie in its buffer of {} bytes", *view_index,
                         there.size()));
    a.size = bytes_of(component, type);
    a.stride = whole(view, "byteStride", a.size);
    if (a.stride < a.size || a.stride > kMostStride)
        fail(fmt::format("bufferView {} has a stride of {} bytes", *view_index, a.stride));
    const std::uint64_t offset = whole(in, "byteOffset", 0);
    if (offset > view_length || view_length - offset < a.size ||
        a.count - 1 > (view_length - offset - a.size) / a.stride)
        fail(fmt::format("accessor {} does not lie in its bufferView of {} bytes", index,
                         view_length));
    a.bytes = there.substr(view_offset + offset, (a.count - 1) * a.stride + a.size);
    return a;
}

Vec3f GltfDocument::vector_at(const Accessor& a, std::uint64_t i) {
    Vec3f value;  // little-endian, as the file
    std::memcpy(&value, a.bytes.data() + i * a.stride, sizeof value);
    return value;
}

std::uint32_t GltfDocument::index_at(const Accessor& a, std::uint64_t i) {
    std::uint32_t value = 0;
    std::memcpy(&value, a.bytes.data() + i * a.stride, a.size);
    return value;
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
