// SPDX-License-Identifier: Apache-2.0
// Wyko's .opd: a directory of named blocks; arrays column by column, from the bottom up.
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <algorithm>
#include <map>

namespace asperity::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "\x01\0Directory\0"sv;
constexpr std::uint64_t kEntryBytes = 24;
constexpr int kArray = 3;

struct Block {
    std::string name;
    int type = 0;
    std::uint64_t at = 0, bytes = 0;
};

bool recognises(std::string_view head) {
    return head.starts_with(kMagic);
}

bool holds_heights(const Block& block) {
    constexpr std::string_view kNames[] = {"RAW DATA", "RAW_DATA", "OPD", "Raw", "SAMPLE_DATA"};
    return block.type == kArray && block.bytes > 0 &&
           std::find(std::begin(kNames), std::end(kNames), block.name) != std::end(kNames);
}

std::vector<Block> read_directory(const BinaryView& view) {
    const auto length = view.little<std::int32_t>(2 + 18);
    if (length < 24 || length % 24 != 0)
        view.refuse(fmt::format("a directory of {} bytes is no multiple of 24", length));
    const std::uint64_t entries = static_cast<std::uint64_t>(length) / kEntryBytes;
    view.need(2, entries, kEntryBytes);
    std::vector<Block> blocks;
    std::uint64_t at = 2 + entries * kEntryBytes;
    for (std::uint64_t k = 1; k < entries; ++k) {
        const std::uint64_t entry = 2 + k * kEntryBytes;
        const auto bytes = view.little<std::int32_t>(entry + 18);
        if (bytes <= 0) continue;
        blocks.push_back({view.text(entry, 16), view.little<std::int16_t>(entry + 16), at,
                          static_cast<std::uint64_t>(bytes)});
        at += static_cast<std::uint64_t>(bytes);
    }
    return blocks;
}

struct Scale {
    double nm = 0, pixel_mm = 0, aspect = 1;
};

Scale read_scale(const BinaryView& view, const std::vector<Block>& blocks) {
    Scale scale;
    double mult = 1;
    for (const Block& block : blocks) {
        if (block.name == "Wavelength")
            scale.nm = static_cast<double>(view.little<float>(block.at));
        else if (block.name == "Mult")
            mult = view.little<std::uint16_t>(block.at);
        else if (block.name == "Pixel_size")
            scale.pixel_mm = static_cast<double>(view.little<float>(block.at));
        else if (block.name == "Aspect")
            scale.aspect = static_cast<double>(view.little<float>(block.at));
    }
    if (!(scale.nm > 0) || !std::isfinite(scale.nm)) view.refuse("the wavelength is missing");
    if (mult == 0) view.refuse("Mult is 0");
    scale.nm /= mult;
    return scale;
}

NumberType array_type(const BinaryView& view, const Block& block) {
    switch (view.little<std::uint16_t>(block.at + 4)) {
        case 1:
            return NumberType::U8;
        case 2:
            return NumberType::I16;
        case 4:
            return NumberType::F32;
    }
    view.refuse(fmt::format("{} has numbers of {} bytes", in_quotes(block.name),
                            view.little<std::uint16_t>(block.at + 4)));
}

Topography read(const HeightsSource& source, const Block& block) {
    const BinaryView view(source.bytes(), source.path());
    const Scale scale = read_scale(view, read_directory(view));
    const NumberType type = array_type(view, block);
    const std::uint64_t columns = view.little<std::uint16_t>(block.at),
                        rows = view.little<std::uint16_t>(block.at + 2), size = size_of(type);
    check_sides(columns, rows, source.path());
    view.need(block.at + 6, columns * rows, size);
    const double limit = type == NumberType::F32 ? 1e38 : type == NumberType::I16 ? 32766 : 1e9;
    Topography t = empty_topography(columns, rows, source.path());
    source.for_each_row(t.ny, [&](int j) {
        const auto row = static_cast<std::size_t>(j);
        for (std::size_t i = 0; i < columns; ++i) {
            const double n =
                number_at(view, type, block.at + 6 + (i * rows + rows - 1 - row) * size);
            const std::size_t k = row * static_cast<std::size_t>(columns) + i;
            if (!std::isfinite(n) || n >= limit)
                t.mark_missing(k);
            else
                t.heights[k] = n * scale.nm * 1e-9;
        }
    });
    const std::string unit = fmt::format("units of {:.6g} nm", scale.nm);
    if (scale.pixel_mm > 0) {
        set_spacing(t, scale.pixel_mm * 1e-3, scale.pixel_mm * scale.aspect * 1e-3, unit,
                    source.path());
    } else {
        set_heights_alone(t, unit);
    }
    t.note("columns from the bottom up");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!recognises(source.head())) view.refuse("not a Wyko file (wrong magic)");
    std::vector<HeightsChannel> channels;
    for (const Block& block : read_directory(view)) {
        if (!holds_heights(block)) continue;
        channels.push_back({block.name,
                            view.little<std::uint16_t>(block.at),
                            view.little<std::uint16_t>(block.at + 2),
                            {},
                            [source, block] { return read(source, block); }});
    }
    return channels;
}

}  // namespace

HeightsFormat opd_format() {
    return {"opd", {"opd"}, "Wyko .opd: raw data of an interferometer", recognises, open, nullptr};
}

}  // namespace asperity::io
