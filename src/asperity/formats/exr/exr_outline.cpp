// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/exr/exr_outline.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace asperity::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "\x76\x2f\x31\x01"sv;
constexpr std::uint32_t kDeep = 0x800, kMultiPart = 0x1000;
constexpr std::uint64_t kMaxHeaderBytes = 1 << 20;
constexpr std::size_t kMaxName = 255;
constexpr std::uint32_t kMaxTileSide = 4096;

// An image of more bytes than this must not be this many times as large as its file.
constexpr std::uint64_t kTrustedBytes = 1 << 20;
constexpr std::uint64_t kMaxCompression = 10000;

// Most numbers in all channels, and in one tile of them.
constexpr std::uint64_t kMaxNumbers = std::uint64_t{1} << 32;
constexpr std::uint64_t kMaxTileNumbers = std::uint64_t{1} << 28;
constexpr std::uint64_t kMaxChannels = 1024;

class OutlineReader {
  public:
    OutlineReader(const InputFile& file, std::string_view bytes, ExrContent content,
                  SizeCheck check_size)
        : file_(file), bytes_(bytes), content_(content), check_size_(check_size) {}

    void check() {
        if (!bytes_.starts_with(kMagic)) fail("not an OpenEXR file (wrong magic)");
        place_ = kMagic.size();
        const auto version = number<std::uint32_t>(place_);
        const bool heights = content_ == ExrContent::Heights;
        if ((version & kMultiPart) != 0)
            fail(heights ? "several parts, heights need one" : "several parts, a picture is one");
        if ((version & kDeep) != 0)
            fail(heights ? "a deep image holds no heights" : "a deep image is no picture");
        place_ += sizeof version;
        for (std::string_view name = word(); !name.empty(); name = word()) check_attribute(name);
        if (nx_ == 0) fail("the header has no data window");
        if (channels_ == 0) fail("the header has no channels");
        check_amounts();
    }

  private:
    void check_attribute(std::string_view name) {
        const std::string_view type = word();
        const auto size = number<std::uint32_t>(place_);
        place_ += sizeof size;
        if (size > bytes_.size() - place_)
            fail(fmt::format("attribute {} claims {} bytes, the header has {} left",
                             in_quotes(name), size, bytes_.size() - place_));
        const std::uint64_t end = place_ + size;
        if (name == "dataWindow") check_window(size);
        if (name == "channels") count_channels(end);
        if (name == "tiles") check_tiles(size);
        if (type == "preview") check_preview(size);
        place_ = end;
    }

    void check_window(std::uint32_t size) {
        if (size != 16) fail("the data window does not have 16 bytes");
        const std::int64_t left = number<std::int32_t>(place_);
        const std::int64_t top = number<std::int32_t>(place_ + 4);
        const std::int64_t right = number<std::int32_t>(place_ + 8);
        const std::int64_t bottom = number<std::int32_t>(place_ + 12);
        if (right < left || bottom < top) fail("the data window is empty");
        nx_ = static_cast<std::uint64_t>(right - left + 1);
        ny_ = static_cast<std::uint64_t>(bottom - top + 1);
        check_size_(nx_, ny_, file_.path());
    }

    // A name, then 16 bytes of description, over and over; an empty name ends the list.
    void count_channels(std::uint64_t end) {
        constexpr std::uint64_t kDescription = 16;
        channels_ = 0;
        while (place_ < end && !word().empty()) {
            ++channels_;
            place_ += kDescription;
        }
        if (place_ > end || channels_ > kMaxChannels) fail("the list of channels is damaged");
    }

    // What the library will allocate, when all sizes are known.
    void check_amounts() const {
        const std::uint64_t numbers = nx_ * ny_ * channels_;
        const std::uint64_t bytes = numbers * sizeof(float);
        if (bytes > kTrustedBytes && bytes / kMaxCompression > file_.size())
            fail(fmt::format("{} x {} samples do not fit a file of {} bytes", nx_, ny_,
                             file_.size()));
        if (numbers > kMaxNumbers)
            fail(fmt::format("{} channels of {} x {} samples are too many", channels_, nx_, ny_));
        if (tile_width_ == 0) return;
        // The file holds a place of 8 bytes for each tile.
        const std::uint64_t tiles =
            ((nx_ + tile_width_ - 1) / tile_width_) * ((ny_ + tile_height_ - 1) / tile_height_);
        if (tiles * 8 > file_.size() || tile_width_ * tile_height_ * channels_ > kMaxTileNumbers)
            fail(fmt::format("tiles of {} x {} samples do not fit a file of {} bytes", tile_width_,
                             tile_height_, file_.size()));
    }

    void check_tiles(std::uint32_t size) {
        if (size != 9) fail("the tile description does not have 9 bytes");
        const auto width = number<std::uint32_t>(place_);
        const auto height = number<std::uint32_t>(place_ + 4);
        if (std::min(width, height) < 1 || std::max(width, height) > kMaxTileSide)
            fail(fmt::format("tiles of {} x {} samples, 1 to {} on a side are allowed", width,
                             height, kMaxTileSide));
        tile_width_ = width;
        tile_height_ = height;
    }

    void check_preview(std::uint32_t size) {
        const std::uint64_t width = number<std::uint32_t>(place_);
        const std::uint64_t height = number<std::uint32_t>(place_ + 4);
        if (width > size || height > size || 8 + 4 * width * height != size)
            fail("the preview does not have the size it claims");
    }

    // Up to and with its NUL.
    std::string_view word() {
        const std::size_t end = bytes_.find('\0', static_cast<std::size_t>(place_));
        if (end == std::string_view::npos) fail("the file ends inside the header");
        const auto text =
            bytes_.substr(static_cast<std::size_t>(place_), end - static_cast<std::size_t>(place_));
        if (text.size() > kMaxName) fail("a name in the header is too long");
        place_ = end + 1;
        return text;
    }

    template <typename Number>
    Number number(std::uint64_t place) const {
        if (place > bytes_.size() || bytes_.size() - place < sizeof(Number))
            fail("the file ends inside the header");
        Number value;
        std::memcpy(&value, bytes_.data() + place, sizeof value);
        return value;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, fmt::format("offset {}: {}", place_, why),
                    file_.path());
    }

    const InputFile& file_;
    std::string_view bytes_;
    ExrContent content_;
    SizeCheck check_size_;
    std::uint64_t place_ = 0;
    std::uint64_t nx_ = 0, ny_ = 0, channels_ = 0;    // 0: not told yet
    std::uint64_t tile_width_ = 0, tile_height_ = 0;  // 0: lines, not tiles
};

}  // namespace

void check_exr_outline(const InputFile& file, ExrContent content, SizeCheck check_size) {
    std::string start(static_cast<std::size_t>(std::min(file.size(), kMaxHeaderBytes)), '\0');
    file.read(0, std::as_writable_bytes(std::span(start)));
    OutlineReader(file, start, content, check_size).check();
}

}  // namespace asperity::io
