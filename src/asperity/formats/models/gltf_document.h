// SPDX-License-Identifier: Apache-2.0
// The JSON of a glTF scene, which may be anything, and the numbers in its buffers.
#pragma once

#include <asperity/formats/models/gltf_buffers.h>

#include <array>
#include <cstdint>
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

    /// A stretch of a buffer that holds `count` equal values, `stride` bytes apart; all of it lies
    /// in the buffer.
    struct Accessor {
        std::string_view bytes;
        std::uint64_t stride = 0, count = 0, size = 0;  ///< of one value, in bytes
    };
    /// Of three floats each.
    Accessor vectors(std::uint64_t index);
    /// Of whole numbers of 1, 2 or 4 bytes.
    Accessor indices(std::uint64_t index);

    static Vec3f vector_at(const Accessor& a, std::uint64_t i);
    static std::uint32_t index_at(const Accessor& a, std::uint64_t i);

    /// In all buffers that were read.
    std::uint64_t bytes_read() const {
        return files_.bytes_read() + (binary_ ? binary_->size() : 0);
    }

    [[noreturn]] void fail(std::string why) const;

  private:
    void parse(const GltfContainer& container);
    void check_version() const;
    Accessor accessor(std::uint64_t index, std::string_view type,
                      std::span<const std::uint64_t> components);
    std::string_view buffer(std::uint64_t index);

    const ModelSource& source_;
    Json json_;
    std::optional<std::string> binary_;  ///< of a .glb
    GltfFiles files_;
    std::vector<std::optional<std::string_view>> buffers_;
};

}  // namespace asperity::io::detail
