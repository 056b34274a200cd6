// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// Content of one frame; the last one of a field holds what is left.
inline constexpr std::uint64_t kFrameBytes = 1 << 20;
/// A field may become so much smaller, no more: a small file cannot ask for all memory there is.
inline constexpr std::uint64_t kMostPacked = 100;

/// The parts, one after the other, as zstd frames of kFrameBytes each, on all threads of the
/// machine; the same bytes for any number of them. Empty if that is not worth it: the parts are
/// small, or would become more than kMostPacked times smaller.
std::vector<std::byte> pack(std::span<const std::span<const std::byte>> parts);

/// Packed data that can be read at any place.
class PackedData {
  public:
    /// `frames` as pack() makes them, of `bytes` of content. Throws std::runtime_error that says
    /// what is wrong with them.
    PackedData(std::vector<std::byte> frames, std::uint64_t bytes);

    /// Fills `content` from byte `begin` on; both lie inside. Throws std::runtime_error.
    void read(std::uint64_t begin, std::span<std::byte> content) const;

  private:
    std::span<const std::byte> frame(std::size_t k) const;

    std::vector<std::byte> frames_;
    std::vector<std::size_t> begins_;  ///< of the frames, and the end
    std::uint64_t bytes_;
};

}  // namespace asperity::io
