// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/packed_data.h>

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

namespace asperity::io {

namespace {

/// Smaller fields are left as they are.
constexpr std::uint64_t kLeastBytes = 1 << 16;
/// The quickest level: higher ones gain little on sums of energies.
constexpr int kLevel = 1;

std::size_t frames_of(std::uint64_t bytes) {
    return static_cast<std::size_t>((bytes + kFrameBytes - 1) / kFrameBytes);
}

std::uint64_t content_of(std::size_t k, std::uint64_t bytes) {
    return std::min(kFrameBytes, bytes - k * kFrameBytes);
}

/// Bytes of the parts, taken as one, from `begin` on: where they stand if that is one place, else
/// copied to `copy`.
std::span<const std::byte> gather(std::span<const std::span<const std::byte>> parts,
                                  std::uint64_t begin, std::size_t count,
                                  std::vector<std::byte>& copy) {
    copy.clear();
    for (const auto part : parts) {
        if (begin >= part.size()) {
            begin -= part.size();
            continue;
        }
        const auto here = part.subspan(static_cast<std::size_t>(begin));
        if (copy.empty() && here.size() >= count) return here.first(count);
        const auto taken = here.first(std::min(count - copy.size(), here.size()));
        copy.insert(copy.end(), taken.begin(), taken.end());
        if (copy.size() == count) break;
        begin = 0;
    }
    return copy;
}

/// What a thread packs with, frame after frame.
class Packer {
  public:
    std::vector<std::byte> pack(std::span<const std::byte> content) {
        frame_.resize(ZSTD_compressBound(kFrameBytes));
        const std::size_t size = ZSTD_compressCCtx(context_.get(), frame_.data(), frame_.size(),
                                                   content.data(), content.size(), kLevel);
        if (ZSTD_isError(size)) throw std::bad_alloc();
        return {frame_.begin(), frame_.begin() + static_cast<std::ptrdiff_t>(size)};
    }
    std::vector<std::byte> copy;  ///< for gather()

  private:
    struct Free {
        void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
    };
    static ZSTD_CCtx* make() {
        if (ZSTD_CCtx* context = ZSTD_createCCtx()) return context;
        throw std::bad_alloc();
    }
    std::unique_ptr<ZSTD_CCtx, Free> context_{make()};
    std::vector<std::byte> frame_;
};

[[noreturn]] void fail(std::size_t k, const char* why) {
    throw std::runtime_error(fmt::format("frame {} {}", k, why));
}

}  // namespace

std::vector<std::byte> pack(std::span<const std::span<const std::byte>> parts) {
    std::uint64_t bytes = 0;
    for (const auto part : parts) bytes += part.size();
    if (bytes < kLeastBytes) return {};
    std::vector<std::vector<std::byte>> frames(frames_of(bytes));
    const auto threads = static_cast<std::size_t>(Run().threads());
    parallel_for(threads, Run().threads(), [&](std::size_t thread) {
        Packer packer;
        for (std::size_t k = thread; k < frames.size(); k += threads)
            frames[k] =
                packer.pack(gather(parts, k * kFrameBytes,
                                   static_cast<std::size_t>(content_of(k, bytes)), packer.copy));
    });
    std::vector<std::byte> all;
    for (const auto& frame : frames) all.insert(all.end(), frame.begin(), frame.end());
    if (all.size() >= bytes || all.size() < bytes / kMostPacked + 1) return {};
    return all;
}

PackedData::PackedData(std::vector<std::byte> frames, std::uint64_t bytes)
    : frames_(std::move(frames)), bytes_(bytes) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < frames_of(bytes); ++k) {
        begins_.push_back(place);
        const std::byte* data = frames_.data() + place;
        const std::size_t left = frames_.size() - place;
        const std::size_t size = ZSTD_findFrameCompressedSize(data, left);
        if (ZSTD_isError(size)) fail(k, "is damaged or cut off");
        if (ZSTD_getFrameContentSize(data, left) != content_of(k, bytes))
            fail(k, "does not hold what it should");
        place += size;
    }
    begins_.push_back(place);
    if (place != frames_.size()) fail(frames_of(bytes), "is one too many");
}

std::span<const std::byte> PackedData::frame(std::size_t k) const {
    return std::span(frames_).subspan(begins_[k], begins_[k + 1] - begins_[k]);
}

void PackedData::read(std::uint64_t begin, std::span<std::byte> content) const {
    if (content.empty()) return;
    const std::uint64_t end = begin + content.size();
    const auto first = static_cast<std::size_t>(begin / kFrameBytes);
    const std::size_t count = frames_of(end) - first;
    parallel_for(count, count > 4 ? Run().threads() : 1, [&](std::size_t n) {
        const std::size_t k = first + n;
        const std::uint64_t frame_begin = k * kFrameBytes;
        const std::uint64_t from = std::max(begin, frame_begin),
                            to = std::min(end, frame_begin + content_of(k, bytes_));
        const auto target = content.subspan(static_cast<std::size_t>(from - begin),
                                            static_cast<std::size_t>(to - from));
        const auto unpack = [&](std::span<std::byte> place) {
            const auto packed = frame(k);
            if (ZSTD_decompress(place.data(), place.size(), packed.data(), packed.size()) !=
                place.size())
                fail(k, "is damaged");
        };
        if (target.size() == content_of(k, bytes_)) {
            unpack(target);
            return;
        }
        std::vector<std::byte> whole(static_cast<std::size_t>(content_of(k, bytes_)));
        unpack(whole);
        std::copy_n(whole.begin() + static_cast<std::ptrdiff_t>(from - frame_begin), target.size(),
                    target.begin());
    });
}

}  // namespace asperity::io
