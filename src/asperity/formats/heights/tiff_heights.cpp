// SPDX-License-Identifier: Apache-2.0
// TIFF as heights: one channel, or colours that are all alike, of 16-bit or 32-bit float samples.
#include <asperity/core/error.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>
#include <tiffio.h>

#include <cstring>
#include <memory>

namespace asperity::io {
namespace {

constexpr double kFullScale = 65535;

bool recognises(std::string_view head) {
    return head.starts_with(std::string_view("II*\0", 4)) ||
           head.starts_with(std::string_view("MM\0*", 4));
}

/// The bytes in memory, as libtiff wants to read them.
struct Memory {
    std::span<const std::byte> bytes;
    std::uint64_t at = 0;
};

tmsize_t read_memory(thandle_t handle, void* to, tmsize_t count) {
    auto* memory = static_cast<Memory*>(handle);
    const std::uint64_t left =
        memory->bytes.size() - std::min<std::uint64_t>(memory->at, memory->bytes.size());
    const auto take = std::min<std::uint64_t>(left, static_cast<std::uint64_t>(count));
    if (take == 0) return 0;  // there may be no bytes at all
    std::memcpy(to, memory->bytes.data() + memory->at, static_cast<std::size_t>(take));
    memory->at += take;
    return static_cast<tmsize_t>(take);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) {
    return 0;
}

toff_t seek_memory(thandle_t handle, toff_t offset, int from) {
    auto* memory = static_cast<Memory*>(handle);
    const std::uint64_t base = from == SEEK_SET   ? 0
                               : from == SEEK_CUR ? memory->at
                                                  : memory->bytes.size();
    const std::uint64_t to = base + offset;
    memory->at = std::min<std::uint64_t>(to, memory->bytes.size());
    return memory->at;
}

int close_memory(thandle_t) {
    return 0;
}

toff_t size_of_memory(thandle_t handle) {
    return static_cast<Memory*>(handle)->bytes.size();
}

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

/// An open image and its layout.
class Image {
  public:
    explicit Image(const HeightsSource& source) : source_(source), memory_{source.bytes(), 0} {
        TIFFSetErrorHandler(nullptr);
        TIFFSetWarningHandler(nullptr);
        tiff_.reset(TIFFClientOpen("heights", "rm", &memory_, read_memory, write_nothing,
                                   seek_memory, close_memory, size_of_memory, nullptr, nullptr));
        if (!tiff_) source.refuse("not a TIFF that can be read");
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &nx);
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &ny);
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_BITSPERSAMPLE, &bits);
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLESPERPIXEL, &channels);
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLEFORMAT, &format);
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_PLANARCONFIG, &planes);
    }

    void check() const {
        check_sides(nx, ny, source_.path());
        const bool words = bits == 16 && format == SAMPLEFORMAT_UINT;
        const bool floats = bits == 32 && format == SAMPLEFORMAT_IEEEFP;
        if (!words && !floats)
            source_.refuse(
                fmt::format("heights need 16-bit or 32-bit float samples, not {} bits "
                            "of format {}",
                            bits, format));
        if (channels < 1 || channels > 4) source_.refuse(fmt::format("{} channels", channels));
        if (TIFFIsTiled(tiff_.get()) != 0) source_.refuse("a TIFF in tiles is not read");
        if (channels > 1 && planes != PLANARCONFIG_CONTIG)
            source_.refuse("a TIFF with separate colour planes is not read");
        const auto row = static_cast<std::uint64_t>(TIFFScanlineSize64(tiff_.get()));
        if (row != std::uint64_t{nx} * channels * bits / 8) source_.refuse("odd rows");
        // No compression of TIFF's packs more than deflate does.
        if (row * ny / 1032 > memory_.bytes.size())
            source_.refuse(
                fmt::format("{} x {} samples do not fit {} bytes", nx, ny, memory_.bytes.size()));
    }

    Topography read() {
        check();
        Topography t = empty_topography(nx, ny, source_.path());
        const std::size_t colours = channels == 2 ? 1 : std::min<std::size_t>(channels, 3);
        const NumberType type = bits == 16 ? NumberType::U16 : NumberType::F32;
        std::vector<std::byte> row(static_cast<std::size_t>(TIFFScanlineSize64(tiff_.get())));
        source_.for_each_row(t.ny, [&](int j) {
            if (TIFFReadScanline(tiff_.get(), row.data(), static_cast<std::uint32_t>(j), 0) != 1)
                source_.refuse(fmt::format("row {} cannot be unpacked", j));
            const BinaryView view(row, source_.path());
            for (std::size_t i = 0; i < nx; ++i)
                take(t, view, type, i, static_cast<std::size_t>(j) * nx + i, colours);
        });
        return t;
    }

    std::uint32_t nx = 0, ny = 0;
    std::uint16_t bits = 1, channels = 1, format = SAMPLEFORMAT_UINT, planes = 1;

  private:
    void take(Topography& t, const BinaryView& row, NumberType type, std::size_t i, std::size_t k,
              std::size_t colours) const {
        const std::uint64_t size = size_of(type), at = i * channels * size;
        const double first = number_at(row, type, at);
        for (std::size_t c = 1; c < colours; ++c) {
            const double other = number_at(row, type, at + c * size);
            if (other != first && !(std::isnan(other) && std::isnan(first)))
                source_.refuse(
                    fmt::format("the colours differ at sample {}, heights need one "
                                "channel",
                                k));
        }
        if (!std::isfinite(first))
            t.mark_missing(k);
        else
            t.heights[k] = type == NumberType::U16 ? first / kFullScale : first;
    }

    const HeightsSource& source_;
    Memory memory_;
    std::unique_ptr<TIFF, CloseTiff> tiff_;
};

Topography read(const HeightsSource& source) {
    Image image(source);
    Topography t = image.read();
    t.note("first row on top");
    t.assume(image.bits == 16 ? "no scale in the file: white is 1 cell, spacing 1 cell"
                              : "no scale in the file: spacing 1 cell, heights in cells");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    // Their directory may stand beyond what was sniffed; the picture is not what was measured
    if (has_park_tags(source.bytes())) return park_tiff_format().open(source);
    const Image image(source);
    image.check();
    return {{"heights", image.nx, image.ny, {}, [source] { return read(source); }}};
}

}  // namespace

HeightsFormat tiff_format() {
    return {"tiff", {"tif", "tiff"}, "TIFF of 16-bit or 32-bit float samples", recognises,
            open,   nullptr};
}

}  // namespace asperity::io
