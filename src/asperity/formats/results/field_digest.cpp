// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/field_digest.h>

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <new>
#include <vector>

namespace asperity::io {

FieldDigest::FieldDigest(std::string_view name, TensorType type,
                         std::span<const std::uint64_t> shape, bool sorted)
    : state_(XXH3_createState()) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_);
    // Lengths go in front of what they count, so that no two fields feed the same bytes.
    const std::array<std::uint64_t, 3> head = {
        name.size(), static_cast<std::uint64_t>(type) + (sorted ? 64 : 0), shape.size()};
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

Digest stored_digest_of(const TensorBlock& block) {
    if (block.packed.empty()) return digest_of(block);
    FieldDigest digest(block.name, block.type, block.shape, block.sorted);
    const std::uint64_t size = block.packed.size();
    digest.update(std::as_bytes(std::span(&size, 1)));
    digest.update(block.packed);
    return digest.finish();
}

namespace {

/// Feeds `bytes` bytes through a buffer that read(begin, part) fills.
template <typename Read>
Digest digest_through(const TensorField& field, std::uint64_t bytes, bool sorted, Read read) {
    // Of packed fields so many frames are unpacked side by side
    constexpr std::uint64_t kBufferBytes = 16 * kFrameBytes;
    std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(kBufferBytes, bytes)));
    FieldDigest digest(field.name, field.type, field.shape, sorted);
    for (std::uint64_t begin = 0; begin < bytes; begin += buffer.size()) {
        const std::uint64_t count = std::min<std::uint64_t>(buffer.size(), bytes - begin);
        const auto part = std::span(buffer).first(static_cast<std::size_t>(count));
        read(begin, part);
        digest.update(part);
    }
    return digest.finish();
}

}  // namespace

Digest digest_of(const TensorFile& file, const TensorField& field) {
    return digest_through(
        field, field.bytes, false,
        [&](std::uint64_t begin, std::span<std::byte> part) { file.read(field, begin, part); });
}

Digest stored_digest_of(const TensorFile& file, const TensorField& field) {
    return digest_through(field, field.stored, field.sorted,
                          [&](std::uint64_t begin, std::span<std::byte> part) {
                              file.read_stored(field, begin, part);
                          });
}

std::string checksum_of(std::span<const Digest> digests) {
    const XXH128_hash_t hash = XXH3_128bits(digests.data(), digests.size_bytes());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace asperity::io
