// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/heights/height_files.h>
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <span>
#include <vector>

namespace asperity::io {
namespace {

// Deflate cannot pack more than 1032 bytes into one.
constexpr std::uint64_t kMaxDeflate = 1032;

// All that libpng's jumps must leave intact lives here, outside the functions they cross.
struct PngInput {
    std::span<const std::byte> rest;
    std::array<char, 200> message{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp why) {
    auto* input = static_cast<PngInput*>(png_get_error_ptr(png));
    std::strncpy(input->message.data(), why, input->message.size() - 1);
    std::longjmp(png_jmpbuf(png), 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep bytes, std::size_t count) {
    auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
    if (count > input->rest.size()) png_error(png, "the file ends early");
    std::memcpy(bytes, input->rest.data(), count);
    input->rest = input->rest.subspan(count);
}

// libpng's reader, and the steps that may jump. They hold no object with a destructor.
class PngReader {
  public:
    explicit PngReader(PngInput& input)
        : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, on_error, on_warning)),
          info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
        if (png_ == nullptr || info_ == nullptr) {
            png_destroy_read_struct(&png_, &info_, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png_, &input, on_read);
        png_set_user_limits(png_, kMaxSurfaceSide, kMaxSurfaceSide);
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    bool read_header() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_info(png_, info_);
        return true;
    }

    /// How often all rows are to be read: an interlaced picture comes in several passes.
    bool begin_rows(int& passes) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        if (depth() == 16) png_set_swap(png_);
        passes = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }
    bool read_row(png_bytep row) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_row(png_, row, nullptr);
        return true;
    }
    bool end_rows() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_end(png_, nullptr);
        return true;
    }

    std::uint64_t width() const { return png_get_image_width(png_, info_); }
    std::uint64_t height() const { return png_get_image_height(png_, info_); }
    int depth() const { return png_get_bit_depth(png_, info_); }
    /// Grey, or colours, which heights take if they are all alike.
    bool usable() const {
        const int type = png_get_color_type(png_, info_);
        return type == PNG_COLOR_TYPE_GRAY || type == PNG_COLOR_TYPE_RGB ||
               type == PNG_COLOR_TYPE_RGB_ALPHA;
    }
    int channels() const { return png_get_channels(png_, info_); }

  private:
    png_structp png_;
    png_infop info_;
};

void check_header(const PngReader& png, std::uint64_t file_bytes, const std::string& path) {
    const auto refuse = [&](std::string why) {
        throw Error(ErrorCode::InvalidInput, std::move(why), path);
    };
    if (!png.usable())
        refuse("heights need a grey PNG, or one whose colours are alike, without palette");
    if (png.depth() != 8 && png.depth() != 16)
        refuse(fmt::format("heights need 8 or 16 bits, not {}", png.depth()));
    check_sides(png.width(), png.height(), path);
    const std::uint64_t bytes = png.width() * png.height() * static_cast<unsigned>(png.channels()) *
                                static_cast<unsigned>(png.depth()) / 8;
    if (bytes / kMaxDeflate > file_bytes)
        refuse(fmt::format("{} x {} samples do not fit a file of {} bytes", png.width(),
                           png.height(), file_bytes));
}

// The value of a sample whose colours are all alike and whose alpha, if there is one, is full.
class Samples {
  public:
    Samples(const PngReader& png, const std::vector<png_byte>& bytes, const std::string& path)
        : deep_(png.depth() == 16),
          channels_(static_cast<std::size_t>(png.channels())),
          bytes_(bytes),
          path_(path) {}

    double full() const { return deep_ ? 65535.0 : 255.0; }
    double at(std::size_t sample) const {
        const unsigned first = number(sample * channels_);
        for (std::size_t c = 1; c < channels_; ++c) {
            const unsigned other = number(sample * channels_ + c);
            const bool alpha = c == 3;
            if (alpha ? other == static_cast<unsigned>(full()) : other == first) continue;
            throw Error(
                ErrorCode::InvalidInput,
                fmt::format("{} at sample {}, heights need one channel",
                            alpha ? "an alpha that is not full" : "the colours differ", sample),
                path_);
        }
        return first;
    }

  private:
    unsigned number(std::size_t k) const {
        if (!deep_) return bytes_[k];
        std::uint16_t value = 0;
        std::memcpy(&value, bytes_.data() + 2 * k, sizeof value);
        return value;
    }

    bool deep_;
    std::size_t channels_;
    const std::vector<png_byte>& bytes_;
    const std::string& path_;
};

}  // namespace

Heightfield read_png_heights(const HeightsSource& source) {
    const std::string& path = source.path();
    const std::span<const std::byte> file = source.bytes();
    PngInput input{file, {}};
    PngReader png(input);
    const auto fail = [&] {
        throw Error(ErrorCode::InvalidInput, fmt::format("PNG: {}", input.message.data()), path);
    };
    if (!png.read_header()) fail();
    check_header(png, file.size(), path);

    // The picture in its own numbers, then as heights.
    Heightfield surface = empty_patch(png.width(), png.height(), path);
    const std::size_t row_bytes = static_cast<std::size_t>(png.width()) *
                                  static_cast<std::size_t>(png.channels()) *
                                  static_cast<std::size_t>(png.depth() / 8);
    std::vector<png_byte> pixels(row_bytes * static_cast<std::size_t>(surface.ny));
    int passes = 1;
    if (!png.begin_rows(passes)) fail();
    source.for_each_row(passes * surface.ny, [&](int j) {
        if (!png.read_row(pixels.data() + static_cast<std::size_t>(j % surface.ny) * row_bytes))
            fail();
    });
    if (!png.end_rows()) fail();
    const Samples samples(png, pixels, path);
    for (std::size_t k = 0; k < surface.heights.size(); ++k)
        surface.heights[k] = static_cast<float>(samples.at(k) / samples.full());
    return surface;
}

}  // namespace asperity::io
