// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/packed_data.h>

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>
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

std::uint64_t content_of_frame(std::size_t k, std::uint64_t bytes) {
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

/// Eight rows of eight bytes as columns: swaps squares of bytes across the diagonal, from the
/// largest on.
void transpose(std::array<std::uint64_t, 8>& rows) {
    const auto swap = [&](std::size_t apart, unsigned shift, std::uint64_t mask) {
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if ((k & apart) != 0) continue;
            const std::uint64_t x = ((rows[k] >> shift) ^ rows[k + apart]) & mask;
            rows[k + apart] ^= x;
            rows[k] ^= x << shift;
        }
    };
    swap(4, 32, 0x00000000ffffffff);
    swap(2, 16, 0x0000ffff0000ffff);
    swap(1, 8, 0x00ff00ff00ff00ff);
}

/// The k-th bytes of all numbers side by side, and back.
template <std::size_t kWidth>
void sort_bytes(const std::byte* numbers, std::size_t count, std::byte* sorted) {
    std::size_t n = 0;
    if constexpr (kWidth == 8)
        for (std::array<std::uint64_t, 8> rows; n + 8 <= count; n += 8) {
            std::memcpy(rows.data(), numbers + n * kWidth, sizeof rows);
            transpose(rows);
            for (std::size_t k = 0; k < kWidth; ++k)
                std::memcpy(sorted + k * count + n, &rows[k], sizeof rows[k]);
        }
    for (; n < count; ++n)
        for (std::size_t k = 0; k < kWidth; ++k) sorted[k * count + n] = numbers[n * kWidth + k];
}

template <std::size_t kWidth>
void unsort_bytes(const std::byte* sorted, std::size_t count, std::byte* numbers) {
    std::size_t n = 0;
    if constexpr (kWidth == 8)
        for (std::array<std::uint64_t, 8> rows; n + 8 <= count; n += 8) {
            for (std::size_t k = 0; k < kWidth; ++k)
                std::memcpy(&rows[k], sorted + k * count + n, sizeof rows[k]);
            transpose(rows);
            std::memcpy(numbers + n * kWidth, rows.data(), sizeof rows);
        }
    for (; n < count; ++n)
        for (std::size_t k = 0; k < kWidth; ++k) numbers[n * kWidth + k] = sorted[k * count + n];
}

/// Calls work(width) with one of the widths there are, known when this is compiled.
template <class Work>
void with_width(std::size_t width, Work work) {
    if (width == 2) work(std::integral_constant<std::size_t, 2>());
    if (width == 4) work(std::integral_constant<std::size_t, 4>());
    if (width == 8) work(std::integral_constant<std::size_t, 8>());
}

/// What a thread packs with, frame after frame.
class Packer {
  public:
    std::vector<std::byte> pack(std::span<const std::byte> content, std::size_t width) {
        if (width > 1) {
            sorted_.resize(content.size());
            with_width(width, [&](auto bytes) {
                sort_bytes<bytes()>(content.data(), content.size() / bytes(), sorted_.data());
            });
            content = sorted_;
        }
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
    std::vector<std::byte> frame_, sorted_;
};

/// First bytes of a frame that zstd skips; a u32 with the number of bytes that follow is the rest
/// of its head.
constexpr std::uint32_t kFilling = 0x184D2A50;

/// At least so many bytes that say nothing.
void append_filling(std::vector<std::byte>& frames, std::uint64_t bytes) {
    const std::array<std::uint32_t, 2> head = {
        kFilling,
        static_cast<std::uint32_t>(std::max<std::uint64_t>(bytes, sizeof head) - sizeof head)};
    const auto bytes_of_head = std::as_bytes(std::span(head));
    frames.insert(frames.end(), bytes_of_head.begin(), bytes_of_head.end());
    frames.resize(frames.size() + head[1]);
}

/// True for one frame that zstd skips, and nothing behind it.
bool is_filling(std::span<const std::byte> data) {
    std::array<std::uint32_t, 2> head = {};
    if (data.size() < sizeof head) return false;
    std::memcpy(head.data(), data.data(), sizeof head);
    return head[0] == kFilling && head[1] == data.size() - sizeof head;
}

[[noreturn]] void fail(std::size_t k, const char* why) {
    throw std::runtime_error(fmt::format("frame {} {}", k, why));
}

}  // namespace

std::vector<std::byte> pack(std::span<const std::span<const std::byte>> parts, std::size_t width) {
    std::uint64_t bytes = 0;
    for (const auto part : parts) bytes += part.size();
    if (bytes < kLeastBytes) return {};
    std::vector<std::vector<std::byte>> frames(frames_of(bytes));
    const auto threads = static_cast<std::size_t>(Run().threads());
    parallel_for(threads, Run().threads(), [&](std::size_t thread) {
        Packer packer;
        for (std::size_t k = thread; k < frames.size(); k += threads)
            frames[k] = packer.pack(
                gather(parts, k * kFrameBytes, static_cast<std::size_t>(content_of_frame(k, bytes)),
                       packer.copy),
                width);
    });
    std::vector<std::byte> all;
    for (const auto& frame : frames) all.insert(all.end(), frame.begin(), frame.end());
    const std::uint64_t least = bytes / kMostPacked + 1;
    if (all.size() < least) append_filling(all, least - all.size());
    if (all.size() >= bytes) return {};
    return all;
}

PackedData::PackedData(std::vector<std::byte> frames, std::uint64_t bytes, std::size_t width)
    : frames_(std::move(frames)), bytes_(bytes), width_(width) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < frames_of(bytes); ++k) {
        begins_.push_back(place);
        const std::byte* data = frames_.data() + place;
        const std::size_t left = frames_.size() - place;
        const std::size_t size = ZSTD_findFrameCompressedSize(data, left);
        if (ZSTD_isError(size)) fail(k, "is damaged or cut off");
        if (ZSTD_getFrameContentSize(data, left) != content_of_frame(k, bytes))
            fail(k, "does not hold what it should");
        place += size;
    }
    begins_.push_back(place);
    if (place != frames_.size() && !is_filling(std::span(frames_).subspan(place)))
        fail(frames_of(bytes), "is one too many");
}

std::span<const std::byte> PackedData::frame(std::size_t k) const {
    return std::span(frames_).subspan(begins_[k], begins_[k + 1] - begins_[k]);
}

std::uint64_t PackedData::content_of(std::size_t k) const {
    return content_of_frame(k, bytes_);
}

void PackedData::unpack(std::size_t k, std::span<std::byte> place) const {
    const auto packed = frame(k);
    const auto decompress = [&](std::byte* to) {
        if (ZSTD_decompress(to, place.size(), packed.data(), packed.size()) != place.size())
            fail(k, "is damaged");
    };
    if (width_ == 1) {
        decompress(place.data());
        return;
    }
    const auto sorted = std::make_unique_for_overwrite<std::byte[]>(place.size());
    decompress(sorted.get());
    with_width(width_, [&](auto bytes) {
        unsort_bytes<bytes()>(sorted.get(), place.size() / bytes(), place.data());
    });
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
                            to = std::min(end, frame_begin + content_of(k));
        const auto target = content.subspan(static_cast<std::size_t>(from - begin),
                                            static_cast<std::size_t>(to - from));
        if (target.size() == content_of(k)) {
            unpack(k, target);
            return;
        }
        std::vector<std::byte> whole(static_cast<std::size_t>(content_of(k)));
        unpack(k, whole);
        std::copy_n(whole.begin() + static_cast<std::ptrdiff_t>(from - frame_begin), target.size(),
                    target.begin());
    });
}

void PackedData::read_parts(std::span<const std::span<std::byte>> parts) const {
    std::vector<std::uint64_t> ends;
    for (const auto part : parts) ends.push_back((ends.empty() ? 0 : ends.back()) + part.size());
    const std::size_t count = begins_.size() - 1;
    parallel_for(count, count > 4 ? Run().threads() : 1, [&](std::size_t k) {
        std::uint64_t at = k * kFrameBytes;
        const std::uint64_t end = at + content_of(k);
        auto p =
            static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin());
        const auto from_at = [&] {
            const std::uint64_t left = ends[p] - at;
            return parts[p]
                .last(static_cast<std::size_t>(left))
                .first(static_cast<std::size_t>(std::min(left, end - at)));
        };
        if (const auto place = from_at(); place.size() == end - at) {
            unpack(k, place);
            return;
        }
        std::vector<std::byte> whole(static_cast<std::size_t>(end - at));
        unpack(k, whole);
        for (const std::byte* next = whole.data(); at < end; ++p) {
            const auto place = from_at();
            std::copy_n(next, place.size(), place.data());
            next += place.size();
            at += place.size();
        }
    });
}

}  // namespace asperity::io
