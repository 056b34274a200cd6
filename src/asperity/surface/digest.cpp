// SPDX-License-Identifier: Apache-2.0
#include <asperity/surface/digest.h>

#include <fmt/format.h>

#include <array>
#include <bit>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace asperity {

std::string digest(const Heightfield& surface) {
    const std::array<std::uint64_t, 6> head = {
        static_cast<std::uint64_t>(surface.nx),       static_cast<std::uint64_t>(surface.ny),
        std::bit_cast<std::uint64_t>(surface.dx),     std::bit_cast<std::uint64_t>(surface.dy),
        static_cast<std::uint64_t>(surface.diagonal), static_cast<std::uint64_t>(surface.boundary)};
    const std::uint64_t seed = XXH3_64bits(head.data(), sizeof head);
    const XXH128_hash_t hash =
        XXH3_128bits_withSeed(surface.heights.data(), surface.heights.size() * sizeof(float), seed);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace asperity
