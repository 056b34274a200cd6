// SPDX-License-Identifier: Apache-2.0
// The numbers that a glTF accessor describes, each decoded when it is asked for: many primitives
// may share one long list.
#pragma once

#include <asperity/render/mesh.h>

#include <cstdint>
#include <string_view>

namespace asperity::io::detail {

/// componentType, glTF 2.0 section 3.6.2.2.
enum class GltfComponent : std::uint64_t {
    Int8 = 5120,
    Uint8 = 5121,
    Int16 = 5122,
    Uint16 = 5123,
    Uint32 = 5125,
    Float = 5126,
};

/// 0 for a number that is no component type.
std::uint64_t bytes_of(GltfComponent component);

/// `count` values that replace those of the accessor, at places that rise strictly.
struct GltfSparse {
    std::uint64_t count = 0;
    std::string_view places;  ///< in the accessor, packed
    GltfComponent place_type = GltfComponent::Uint32;
    std::string_view values;  ///< packed
};

/// `count` values of `size` bytes each, `stride` bytes apart; all zero where there are no bytes.
/// Whoever fills it makes sure that all of them lie in the bytes.
struct GltfAccessor {
    std::string_view bytes;
    std::uint64_t stride = 0, count = 0, size = 0;
    GltfComponent component = GltfComponent::Float;
    bool normalized = false;  ///< whole numbers stand for -1 to 1, or 0 to 1
    GltfSparse sparse;

    /// Of three components.
    Vec3f vector_at(std::uint64_t i) const;
    /// Of one that is a whole number without a sign.
    std::uint32_t index_at(std::uint64_t i) const;

  private:
    const char* place_of(std::uint64_t i) const;
};

/// The k-th place of a sparse list.
std::uint32_t sparse_place(const GltfSparse& sparse, std::uint64_t k);

}  // namespace asperity::io::detail
