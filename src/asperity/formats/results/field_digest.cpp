// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/field_digest.h>

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <new>
#include <vector>

namespace asperity::io {

FieldDigest::FieldDigest(std::string_view name, TensorType type,
                         std::span<const std::uint64_t> shape)
    : state_(XXH3_createState()) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_);
    // Lengths go in front of what they count, so that no two fields feed the same bytes.
    const std::array<std::uint64_t, 3> head = {name.size(), static_cast<std::uint64_t>(type),
                                               shape.size()};
    update(std::as_bytes(std::span(head)));
    update(std::as_bytes(std::span(name)));
    update(std::as_bytes(shape));
}

FieldDigest::~FieldDigest() {
    XXH3_freeState(state_);
}

void FieldDigest::update(std::span<const std::byte> bytes) {
    if (!bytes.empty()) XXH3_128bits_update(state_, bytes.data(), bytes.size());
}

Digest FieldDigest::finish() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_);
    return {hash.low64, hash.high64};
}

Digest digest_of(const TensorBlock& block) {
    FieldDigest digest(block.name, block.type, block.shape);
    for (const auto part : block.parts) digest.update(part);
    return digest.finish();
}

Digest digest_of(const TensorFile& file, const TensorField& field) {
    constexpr std::uint64_t kBufferBytes = 1 << 20;
    std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(kBufferBytes, field.bytes)));
    FieldDigest digest(field.name, field.type, field.shape);
    for (std::uint64_t begin = 0; begin < field.bytes; begin += buffer.size()) {
        const std::uint64_t count = std::min<std::uint64_t>(buffer.size(), field.bytes - begin);
        const auto part = std::span(buffer).first(static_cast<std::size_t>(count));
        file.read(field, begin, part);
        digest.update(part);
    }
    return digest.finish();
}

std::string checksum_of(std::span<const Digest> digests) {
    const XXH128_hash_t hash = XXH3_128bits(digests.data(), digests.size_bytes());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace asperity::io
