// SPDX-License-Identifier: Apache-2.0
// Digital Surf's .sur and .pro: objects one after the other, each a header of 512 bytes, a comment,
// a private zone and 16- or 32-bit integers, perhaps compressed.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>
#include <asperity/formats/heights/zlib_inflate.h>

#include <algorithm>
#include <limits>

namespace asperity::io {
namespace {

constexpr std::string_view kPlain = "DIGITAL SURF", kCompressed = "DSCOMPRESSED";
constexpr std::uint64_t kHeaderBytes = 512;
constexpr int kMaxObjects = 1000;

struct Object {
    std::uint64_t header = 0, data = 0, end = 0;  ///< bytes in the file
    bool compressed = false;
};

bool recognises(std::string_view head) {
    return head.starts_with(kPlain) || head.starts_with(kCompressed);
}

/// u32 count, count x (u32 raw, u32 zipped), then the streams.
struct Blocks {
    std::uint32_t count = 0;
    std::uint64_t first = 0, raw = 0, end = 0;
};

Blocks read_blocks(const BinaryView& view, std::uint64_t at) {
    Blocks blocks;
    blocks.count = view.little<std::uint32_t>(at);
    view.need(at + 4, blocks.count, 8);
    blocks.first = blocks.end = at + 4 + std::uint64_t{8} * blocks.count;
    for (std::uint64_t k = 0; k < blocks.count; ++k) {
        blocks.raw += view.little<std::uint32_t>(at + 4 + 8 * k);
        blocks.end += view.little<std::uint32_t>(at + 8 + 8 * k);
    }
    view.need(blocks.first, blocks.end - blocks.first);
    return blocks;
}

std::vector<std::byte> unpack(const BinaryView& view, std::uint64_t at) {
    const Blocks blocks = read_blocks(view, at);
    std::vector<std::byte> all;
    std::uint64_t stream = blocks.first;
    for (std::uint64_t k = 0; k < blocks.count; ++k) {
        const auto zipped = view.little<std::uint32_t>(at + 8 + 8 * k);
        const auto part = inflated(view.part(stream, zipped),
                                   view.little<std::uint32_t>(at + 4 + 8 * k), view.path());
        all.insert(all.end(), part.begin(), part.end());
        stream += zipped;
    }
    return all;
}

Object read_object(const BinaryView& view, std::uint64_t at) {
    Object object;
    object.header = at;
    const std::string magic = view.text(at, 12);
    if (magic != kPlain && magic != kCompressed)
        view.refuse(fmt::format("no Digital Surf object at byte {}", at));
    object.compressed = magic == kCompressed;
    view.need(at, kHeaderBytes);
    if (view.little<std::int16_t>(at + 12) != 0)
        view.refuse("the object is of the Macintosh kind, which is not read");
    object.data = at + kHeaderBytes + view.little<std::uint16_t>(at + 334) +
                  view.little<std::uint16_t>(at + 336);
    if (object.compressed) {
        object.end = read_blocks(view, object.data).end;
    } else {
        const auto nx = view.little<std::int32_t>(at + 108),
                   ny = view.little<std::int32_t>(at + 112);
        if (nx <= 0 || ny <= 0) view.refuse(fmt::format("{} x {} is no size", nx, ny));
        const std::uint64_t size = view.little<std::int16_t>(at + 98) == 16 ? 2 : 4;
        object.end =
            object.data + static_cast<std::uint64_t>(nx) * static_cast<std::uint64_t>(ny) * size;
    }
    return object;
}

double unit_at(const BinaryView& view, std::uint64_t at, const char* what) {
    const std::string unit = view.text(at, 16);
    const double metres = metres_per(unit);
    if (metres == 0)
        view.refuse(fmt::format("the unit of {}, {}, is none of length", what, in_quotes(unit)));
    return metres;
}

// Type 7 and 8 hold several layers in one object, which no file at hand shows.
std::string other_than_heights(const BinaryView& view, std::uint64_t at) {
    switch (view.little<std::int16_t>(at + 18)) {
        case 1:
            return "a profile";
        case 2:
        case 11:
        case 13:
        case 14:
            break;
        case 3:
            return "a binary image";
        case 7:
        case 8:
            return "several layers in one object";
        case 10:
            return "intensities";
        case 12:
            return "colours";
        default:
            return fmt::format("an object of type {}", view.little<std::int16_t>(at + 18));
    }
    const std::string unit = view.text(at + 212, 16);
    return metres_per(unit) == 0 ? "in " + in_quotes(unit) : "";
}

// 1: upside down; 2, 3: and mirrored along x, along y.
void invert(Topography& t, int inverted) {
    if (inverted == 0) return;
    t.note(inverted == 1 ? "heights turned over, as the header says"
                         : "heights turned over and mirrored, as the header says");
    for (double& h : t.heights) h = -h;
    const auto flip = [&](auto& values) {
        if (values.empty()) return;
        for (int j = 0; j < t.ny; ++j)
            if (inverted == 2)
                std::reverse(values.begin() + std::ptrdiff_t{j} * t.nx,
                             values.begin() + std::ptrdiff_t{j + 1} * t.nx);
        for (int j = 0; inverted == 3 && j < t.ny / 2; ++j)
            std::swap_ranges(values.begin() + std::ptrdiff_t{j} * t.nx,
                             values.begin() + std::ptrdiff_t{j + 1} * t.nx,
                             values.begin() + std::ptrdiff_t{t.ny - 1 - j} * t.nx);
    };
    flip(t.heights);
    flip(t.missing);
}

Topography read(const HeightsSource& source, const Object& object) {
    const BinaryView file(source.bytes(), source.path());
    const std::uint64_t at = object.header;
    const auto bits = file.little<std::int16_t>(at + 98);
    if (bits != 16 && bits != 32) file.refuse(fmt::format("{} bits a point, not 16 or 32", bits));
    const auto nx = file.little<std::int32_t>(at + 108), ny = file.little<std::int32_t>(at + 112);
    if (nx <= 0 || ny <= 0) file.refuse(fmt::format("{} x {} is no size", nx, ny));
    const double x = unit_at(file, at + 180, "dx"), y = unit_at(file, at + 196, "dy"),
                 z = unit_at(file, at + 212, "dz");
    const double missing = file.little<std::int16_t>(at + 86) == 1
                               ? static_cast<double>(file.little<std::int32_t>(at + 100)) - 2
                               : std::numeric_limits<double>::quiet_NaN();
    GridNumbers numbers;
    numbers.type = bits == 16 ? NumberType::I16 : NumberType::I32;
    numbers.scale = static_cast<double>(file.little<float>(at + 128)) * z;
    if (!std::isfinite(numbers.scale) || numbers.scale == 0)
        file.refuse("the height of a count is no length");

    std::vector<std::byte> unpacked;
    if (object.compressed) unpacked = unpack(file, object.data);
    const BinaryView data = object.compressed ? BinaryView(unpacked, source.path()) : file;
    numbers.at = object.compressed ? 0 : object.data;
    Topography t =
        read_grid(source, data, static_cast<std::uint64_t>(nx), static_cast<std::uint64_t>(ny),
                  numbers, [&](double n) { return n == missing; });
    set_spacing(t, static_cast<double>(file.little<float>(at + 120)) * x,
                static_cast<double>(file.little<float>(at + 124)) * y,
                fmt::format("steps of {}", length_text(std::abs(numbers.scale))), source.path());
    t.note("first row on top");
    if (const float z0 = file.little<float>(at + 474); z0 != 0)
        t.assume(fmt::format("the offset of {:.6g} in the header is left out", z0));
    invert(t, file.little<std::int16_t>(at + 290));
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a Digital Surf file (wrong magic)");
    const int claimed = view.little<std::int16_t>(14);
    const int count = std::clamp(claimed, 1, kMaxObjects);
    std::vector<HeightsChannel> channels;
    std::uint64_t at = 0;
    for (int k = 0; k < count; ++k) {
        const Object object = read_object(view, at);
        const std::string title = view.text(at + 20, 30);
        channels.push_back({title.empty() ? fmt::format("object {}", k + 1) : title,
                            view.little<std::uint32_t>(at + 108),
                            view.little<std::uint32_t>(at + 112), other_than_heights(view, at),
                            [source, object] { return read(source, object); }});
        at = object.end;
    }
    return channels;
}

}  // namespace

HeightsFormat sur_format() {
    return {"sur",
            {"sur", "pro"},
            "Digital Surf .sur, .pro: surfaces, plain or compressed, one or several",
            recognises,
            open,
            nullptr};
}

}  // namespace asperity::io
