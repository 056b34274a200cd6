// SPDX-License-Identifier: Apache-2.0
#include <asperity/io/exr_outline.h>

#include <asperity/core/error.h>
#include <asperity/io/height_files.h>
#include <asperity/io/parse_number.h>
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

class OutlineReader {
  public:
    OutlineReader(const InputFile& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    void check() {
        if (!bytes_.starts_with(kMagic)) fail("not an OpenEXR file (wrong magic)");
        place_ = kMagic.size();
        const auto version = number<std::uint32_t>(place_);
        if ((version & kMultiPart) != 0) fail("several parts, heights need one");
        if ((version & kDeep) != 0) fail("a deep image holds no heights");
        place_ += sizeof version;
        for (std::string_view name = word(); !name.empty(); name = word()) check_attribute(name);
        if (!has_window_) fail("the header has no data window");
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
        const auto nx = static_cast<std::uint64_t>(right - left + 1);
        const auto ny = static_cast<std::uint64_t>(bottom - top + 1);
        check_sides(nx, ny, file_.path());
        const std::uint64_t bytes = nx * ny * sizeof(float);
        if (bytes > kTrustedBytes && bytes / kMaxCompression > file_.size())
            fail(
                fmt::format("{} x {} samples do not fit a file of {} bytes", nx, ny, file_.size()));
        has_window_ = true;
    }

    void check_tiles(std::uint32_t size) {
        if (size != 9) fail("the tile description does not have 9 bytes");
        const auto width = number<std::uint32_t>(place_);
        const auto height = number<std::uint32_t>(place_ + 4);
        if (std::min(width, height) < 1 || std::max(width, height) > kMaxTileSide)
            fail(fmt::format("tiles of {} x {} samples, 1 to {} on a side are allowed", width,
                             height, kMaxTileSide));
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
    std::uint64_t place_ = 0;
    bool has_window_ = false;
};

}  // namespace

void check_exr_outline(const InputFile& file) {
    std::string start(static_cast<std::size_t>(std::min(file.size(), kMaxHeaderBytes)), '\0');
    file.read(0, std::as_writable_bytes(std::span(start)));
    OutlineReader(file, start).check();
}

}  // namespace asperity::io
