// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/images/render_writer.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <new>

namespace asperity::io {

namespace {

// All that libpng's jumps must leave intact lives here, outside the functions they cross.
struct PngOutput {
    std::string bytes;
    std::array<char, 200> message{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp why) {
    auto* output = static_cast<PngOutput*>(png_get_error_ptr(png));
    std::strncpy(output->message.data(), why, output->message.size() - 1);
    std::longjmp(png_jmpbuf(png), 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep bytes, std::size_t count) {
    auto* output = static_cast<PngOutput*>(png_get_io_ptr(png));
    bool fits = true;
    try {
        output->bytes.append(reinterpret_cast<const char*>(bytes), count);
    } catch (const std::bad_alloc&) {  // must not fly through libpng
        fits = false;
    }
    if (!fits) png_error(png, "out of memory");
}

void on_flush(png_structp) {}

/// What stands in a file before its pixels.
struct PngHeader {
    int width = 0, height = 0;
    Transfer transfer = Transfer::Srgb;
    std::vector<png_text> texts;
};

// libpng's writer, and the step that may jump. It holds no object with a destructor.
class PngWriter {
  public:
    explicit PngWriter(PngOutput& output)
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, on_error, on_warning)),
          info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
        if (png_ == nullptr || info_ == nullptr) {
            png_destroy_write_struct(&png_, &info_);
            throw std::bad_alloc();
        }
        png_set_write_fn(png_, &output, on_write, on_flush);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    bool write(const PngHeader& header, png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(header.width),
                     static_cast<png_uint_32>(header.height), 8, PNG_COLOR_TYPE_RGB,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        if (header.transfer == Transfer::Srgb)
            png_set_sRGB(png_, info_, PNG_sRGB_INTENT_RELATIVE);
        else
            png_set_gAMA(png_, info_, header.transfer == Transfer::Gamma22 ? 1 / 2.2 : 1.0);
        if (!header.texts.empty())
            png_set_text(png_, info_, header.texts.data(), static_cast<int>(header.texts.size()));
        png_write_info(png_, info_);
        png_write_image(png_, rows);
        png_write_end(png_, info_);
        return true;
    }

  private:
    png_structp png_;
    png_infop info_;
};

/// A text chunk: plain when the value is ASCII, else one for UTF-8. Refers to both strings.
png_text text_chunk(std::string& name, std::string& value) {
    const bool ascii = std::all_of(value.begin(), value.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    png_text text{};
    text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    text.key = name.data();
    text.text = value.data();
    (ascii ? text.text_length : text.itxt_length) = value.size();
    return text;
}

}  // namespace

void write_render_png(const Film& film, const ToneMapping& mapping, const Provenance& provenance,
                      const std::string& path) {
    std::vector<std::uint8_t> bytes = to_bytes(mapping, film.image());
    std::vector<png_bytep> rows;
    for (std::size_t y = 0; y < static_cast<std::size_t>(film.height()); ++y)
        rows.push_back(bytes.data() + 3 * y * static_cast<std::size_t>(film.width()));

    Provenance labels = labelled(provenance);
    PngHeader header{film.width(), film.height(), mapping.transfer, {}};
    for (auto& [name, value] : labels) header.texts.push_back(text_chunk(name, value));

    AtomicFile file(path);  // first: it tells of a folder that may not be written
    PngOutput output;
    PngWriter writer(output);
    if (!writer.write(header, rows.data()))
        throw Error(ErrorCode::InputOutput,
                    fmt::format("cannot write the PNG ({})", output.message.data()), path);
    file.write(output.bytes);
    file.commit();
}

}  // namespace asperity::io
