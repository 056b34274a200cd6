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
inline constexpr std::uint64_t kMostPacked = 400;

/// The parts, one after the other, as zstd frames of kFrameBytes each, on all threads of the
/// machine; the same bytes for any number of them. Of numbers of `width` bytes each frame holds
/// first the lowest byte of all, then the second one and so on: of energies the high ones are
/// alike. `width` divides kFrameBytes and the parts together. What would become more than
/// kMostPacked times smaller gets a frame behind it that zstd skips. Empty if that is not worth it.
std::vector<std::byte> pack(std::span<const std::span<const std::byte>> parts,
                            std::size_t width = 1);

/// Packed data that can be read at any place.
class PackedData {
  public:
    /// `frames` as pack() makes them, of `bytes` of content. Throws std::runtime_error that says
    /// what is wrong with them.
    PackedData(std::vector<std::byte> frames, std::uint64_t bytes, std::size_t width = 1);

    /// Fills `content` from byte `begin` on; both lie inside. Throws std::runtime_error.
    void read(std::uint64_t begin, std::span<std::byte> content) const;
    /// Fills the parts, one after the other, with all there is, on all threads of the machine.
    void read_parts(std::span<const std::span<std::byte>> parts) const;

  private:
    std::uint64_t content_of(std::size_t k) const;
    /// Frame k into a place of that size.
    void unpack(std::size_t k, std::span<std::byte> place) const;
    std::span<const std::byte> frame(std::size_t k) const;

    std::vector<std::byte> frames_;
    std::vector<std::size_t> begins_;  ///< of the frames, and the end
    std::uint64_t bytes_;
    std::size_t width_;
};

}  // namespace asperity::io
