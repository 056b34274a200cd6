// SPDX-License-Identifier: Apache-2.0
// Park Systems' TIFF: the picture is a thumbnail; the samples and their header stand in tags of the
// company's own. The first line of the samples is the bottom one.
#include <asperity/core/length.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <map>

namespace asperity::io {
namespace {

using namespace std::string_view_literals;

constexpr std::uint16_t kMagicTag = 50432, kVersionTag = 50433, kDataTag = 50434,
                        kHeaderTag = 50435;
constexpr std::uint32_t kMagic = 0x0e031301, kVersion1 = 0x01000001, kVersion2 = 0x01000002;
constexpr std::uint64_t kEntryBytes = 12;

// Places in the header, all little-endian.
constexpr std::uint64_t kImageType = 0, kName = 4, kSides = 100, kSwapped = 136, kSize = 140,
                        kGain = 220, kScale = 228, kOffset = 236, kUnit = 244, kDataType = 348;
constexpr std::uint64_t kHeaderBytes1 = 284, kHeaderBytes2 = 360;

struct Tag {
    std::uint32_t count = 0, value = 0;  ///< the value, or where it stands
};

/// The tags of the first directory of a TIFF that ends where `bytes` end; those beyond are left.
std::map<std::uint16_t, Tag> tags_of(std::span<const std::byte> bytes) {
    std::map<std::uint16_t, Tag> tags;
    const BinaryView view(bytes, "");
    if (view.size() < 8 || view.little<std::uint32_t>(0) != 0x002a4949) return tags;
    const std::uint64_t at = view.little<std::uint32_t>(4);
    if (at + 2 > view.size()) return tags;
    const std::uint64_t count = view.little<std::uint16_t>(at);
    for (std::uint64_t k = 0; k < count; ++k) {
        const std::uint64_t entry = at + 2 + kEntryBytes * k;
        if (entry + kEntryBytes > view.size()) break;
        tags[view.little<std::uint16_t>(entry)] = {view.little<std::uint32_t>(entry + 4),
                                                   view.little<std::uint32_t>(entry + 8)};
    }
    return tags;
}

bool has_magic(const std::map<std::uint16_t, Tag>& tags) {
    const auto magic = tags.find(kMagicTag);
    return magic != tags.end() && magic->second.value == kMagic;
}

bool recognises(std::string_view head) {
    return has_park_tags(std::as_bytes(std::span(head)));
}

/// 16-bit letters; those beyond Latin-1 become '?'.
std::string letters(const BinaryView& view, std::uint64_t at, std::uint64_t count) {
    std::string text;
    for (std::uint64_t k = 0; k < count; ++k) {
        const auto letter = view.little<std::uint16_t>(at + 2 * k);
        if (letter == 0) break;
        text += letter < 256 ? static_cast<char>(letter) : '?';
    }
    return std::string(trimmed(text));
}

struct Scan {
    std::uint64_t data = 0, data_bytes = 0, nx = 0, ny = 0;
    double width = 0, height = 0;            ///< um
    double gain = 1, scale = 1, offset = 0;  ///< gain (scale number + offset) in `unit`
    std::uint32_t type = 0;                  ///< 0: 16 bits, 1: 32 bits, 2: floats
    std::string name, unit;
    bool swapped = false;
};

Scan read_header(const HeightsSource& source) {
    const auto tags = tags_of(source.bytes());
    const BinaryView view(source.bytes(), source.path());
    if (!has_magic(tags)) view.refuse("not a TIFF of Park Systems (no tag 50432 of theirs)");
    for (const std::uint16_t tag : {kVersionTag, kDataTag, kHeaderTag})
        if (!tags.contains(tag)) view.refuse(fmt::format("the tag {} is missing", tag));
    const std::uint32_t version = tags.at(kVersionTag).value;
    if (version != kVersion1 && version != kVersion2)
        view.refuse(fmt::format("version {:#x} is neither 1 nor 2", version));
    const std::uint64_t wanted = version == kVersion2 ? kHeaderBytes2 : kHeaderBytes1;
    const Tag header = tags.at(kHeaderTag);
    if (header.count < wanted)
        view.refuse(fmt::format("a header of {} bytes is too short", header.count));
    view.need(header.value, header.count);
    const std::uint64_t at = header.value;
    if (view.little<std::uint32_t>(at + kImageType) == 1)
        view.refuse("a line profile, not a surface");
    Scan scan;
    scan.data = tags.at(kDataTag).value;
    scan.data_bytes = tags.at(kDataTag).count;
    scan.nx = view.little<std::uint32_t>(at + kSides);
    scan.ny = view.little<std::uint32_t>(at + kSides + 4);
    scan.width = view.little<double>(at + kSize);
    scan.height = view.little<double>(at + kSize + 8);
    scan.gain = view.little<double>(at + kGain);
    scan.scale = view.little<double>(at + kScale);
    if (scan.scale == 0) scan.scale = 1;  // as the maker has it
    scan.offset = view.little<double>(at + kOffset);
    scan.name = letters(view, at + kName, 32);
    scan.unit = letters(view, at + kUnit, 8);
    if (scan.unit.empty()) scan.unit = "um";
    scan.swapped = view.little<std::uint32_t>(at + kSwapped) != 0;
    if (version == kVersion2) scan.type = view.little<std::uint32_t>(at + kDataType);
    if (scan.type > 2) view.refuse(fmt::format("samples of type {} are not known", scan.type));
    return scan;
}

Topography read(const HeightsSource& source, const Scan& scan) {
    const BinaryView view(source.bytes(), source.path());
    check_sides(scan.nx, scan.ny, source.path());
    constexpr NumberType kTypes[] = {NumberType::I16, NumberType::I32, NumberType::F32};
    const double unit = metres_per(scan.unit);
    const GridNumbers numbers{kTypes[scan.type],
                              false,
                              scan.data,
                              0,
                              scan.gain * scan.scale * unit,
                              scan.gain * scan.offset * unit};
    if (!std::isfinite(numbers.scale) || numbers.scale == 0 || !std::isfinite(numbers.offset))
        view.refuse("gain, scale and offset give no height of a count");
    if (const std::uint64_t bytes = scan.nx * scan.ny * size_of(numbers.type);
        scan.data_bytes < bytes)
        view.refuse(fmt::format("{} x {} samples need {} bytes, the tag 50434 holds {}", scan.nx,
                                scan.ny, bytes, scan.data_bytes));
    Topography t = read_grid(source, view, scan.nx, scan.ny, numbers, never_missing);
    turn_rows(t);
    set_spacing(t, scan.width * 1e-6 / t.nx, scan.height * 1e-6 / t.ny, scan.unit, source.path());
    t.note("last row on top");
    if (scan.swapped) t.assume("the scan ran along y: rows are taken as they stand");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const Scan scan = read_header(source);
    return {{scan.name.empty() ? "heights" : scan.name, scan.nx, scan.ny,
             metres_per(scan.unit) > 0 ? "" : "in " + in_quotes(scan.unit),
             [source, scan] { return read(source, scan); }}};
}

}  // namespace

bool has_park_tags(std::span<const std::byte> bytes) {
    return has_magic(tags_of(bytes));
}

HeightsFormat park_tiff_format() {
    return {"park-tiff", {},   "Park Systems' TIFF: the samples in its own tags",
            recognises,  open, nullptr};
}

}  // namespace asperity::io
