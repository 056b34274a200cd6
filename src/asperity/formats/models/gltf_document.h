// SPDX-License-Identifier: Apache-2.0
// The JSON of a glTF scene, which may be anything, and the numbers in its buffers.
#pragma once

#include <asperity/formats/models/gltf_accessor.h>
#include <asperity/formats/models/gltf_buffers.h>

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io::detail {

/// All functions throw Error(InvalidInput, path).
class GltfDocument {
  public:
    using Json = nlohmann::json;

    explicit GltfDocument(const ModelSource& source);

    const Json& root() const { return json_; }

    // Reading JSON that may be anything

    static const Json* find(const Json& object, const char* key);
    /// Empty when there is none.
    const Json& list(const Json& object, const char* key) const;
    const Json& entry(const char* key, std::uint64_t index) const;
    std::size_t entries(const char* key) const { return list(json_, key).size(); }
    std::optional<std::uint64_t> optional_whole(const Json& object, const char* key) const;
    std::uint64_t whole(const Json& object, const char* key, std::uint64_t otherwise) const;
    std::vector<std::uint64_t> wholes(const Json& object, const char* key) const;
    /// `size` numbers, or nothing when there is no such key.
    std::vector<double> numbers(const Json& object, const char* key, std::size_t size) const;

    // Reading buffers

    /// Of three floats each; of whole numbers where the file says KHR_mesh_quantization.
    GltfAccessor vectors(std::uint64_t index);
    /// Of whole numbers of 1, 2 or 4 bytes.
    GltfAccessor indices(std::uint64_t index);

    /// In all buffers that were read.
    std::uint64_t bytes_read() const {
        return files_.bytes_read() + (binary_ ? binary_->size() : 0);
    }

    [[noreturn]] void fail(std::string why) const;

  private:
    void parse(const GltfContainer& container);
    void check_version() const;
    bool uses(std::string_view extension) const;
    GltfAccessor accessor(std::uint64_t index, std::string_view type,
                          std::span<const GltfComponent> components);
    GltfSparse sparse_list(const Json& in, const GltfAccessor& of);
    /// `bytes` of a bufferView from an offset on.
    std::string_view stretch(std::uint64_t view, std::uint64_t offset, std::uint64_t bytes,
                             std::string_view whose);
    std::string_view buffer(std::uint64_t index);

    const ModelSource& source_;
    Json json_;
    std::optional<std::string> binary_;  ///< of a .glb
    GltfFiles files_;
    std::vector<std::optional<std::string_view>> buffers_;
    std::map<std::uint64_t, GltfAccessor> accessors_;  ///< that were looked at before
};

}  // namespace asperity::io::detail
