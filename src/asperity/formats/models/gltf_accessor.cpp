// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/gltf_accessor.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace asperity::io::detail {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the file

template <typename Number>
Number number_at(const char* place) {
    Number value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

std::uint32_t whole_at(const char* place, GltfComponent type) {
    switch (type) {
        case GltfComponent::Uint8:
            return number_at<std::uint8_t>(place);
        case GltfComponent::Uint16:
            return number_at<std::uint16_t>(place);
        default:
            return number_at<std::uint32_t>(place);
    }
}

/// Section 3.6.2.2: f = c / most, and not below -1.
template <typename Number>
float decoded(const char* place, bool normalized) {
    const auto value = static_cast<float>(number_at<Number>(place));
    constexpr auto most = static_cast<float>(std::numeric_limits<Number>::max());
    return normalized ? std::max(value / most, -1.0f) : value;
}

float component_at(const char* place, GltfComponent type, bool normalized) {
    switch (type) {
        case GltfComponent::Int8:
            return decoded<std::int8_t>(place, normalized);
        case GltfComponent::Uint8:
            return decoded<std::uint8_t>(place, normalized);
        case GltfComponent::Int16:
            return decoded<std::int16_t>(place, normalized);
        case GltfComponent::Uint16:
            return decoded<std::uint16_t>(place, normalized);
        default:
            return number_at<float>(place);
    }
}

}  // namespace

std::uint64_t bytes_of(GltfComponent component) {
    switch (component) {
        case GltfComponent::Int8:
        case GltfComponent::Uint8:
            return 1;
        case GltfComponent::Int16:
        case GltfComponent::Uint16:
            return 2;
        case GltfComponent::Uint32:
        case GltfComponent::Float:
            return 4;
    }
    return 0;
}

std::uint32_t sparse_place(const GltfSparse& sparse, std::uint64_t k) {
    return whole_at(sparse.places.data() + k * bytes_of(sparse.place_type), sparse.place_type);
}

const char* GltfAccessor::place_of(std::uint64_t i) const {
    std::uint64_t low = 0, high = sparse.count;
    while (low < high) {  // the first place that is not before i
        const std::uint64_t middle = (low + high) / 2;
        if (sparse_place(sparse, middle) < i)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < sparse.count && sparse_place(sparse, low) == i)
        return sparse.values.data() + low * size;
    return bytes.empty() ? nullptr : bytes.data() + i * stride;
}

Vec3f GltfAccessor::vector_at(std::uint64_t i) const {
    const char* const place = place_of(i);
    if (!place) return {0, 0, 0};
    const std::uint64_t step = bytes_of(component);
    return {component_at(place, component, normalized),
            component_at(place + step, component, normalized),
            component_at(place + 2 * step, component, normalized)};
}

std::uint32_t GltfAccessor::index_at(std::uint64_t i) const {
    const char* const place = place_of(i);
    return place ? whole_at(place, component) : 0;
}

}  // namespace asperity::io::detail
