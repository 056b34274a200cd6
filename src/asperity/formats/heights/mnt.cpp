// SPDX-License-Identifier: Apache-2.0
// Digital Surf's Mountains documents (.mnt): a compound file whose stream ScopedContents is a tree
// of entries (u16 tag, u64 size, data or entries). The maker has published no layout; this one is
// what SurfaceTopography found. Only measured surfaces are stored; what was computed of them is
// not.
#include <asperity/core/length.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/compound_file.h>
#include <asperity/formats/heights/grid_reader.h>
#include <asperity/formats/heights/zlib_inflate.h>

#include <initializer_list>

namespace asperity::io {
namespace {

constexpr std::uint64_t kEntryHead = 10;  ///< tag and size
constexpr std::uint32_t kSurface = 9012, kSurfaceData = 9062, kMask = 9056;
constexpr std::uint16_t kBase = 0xffff;  ///< tag of what an object has from the kind above it
constexpr std::byte kMeasured{9};        ///< in a mask
constexpr std::uint64_t kMostPacked = 1032;

using Bytes = std::span<const std::byte>;

/// The entries of a part, in order. Whatever does not fit ends the list.
struct Entry {
    std::uint16_t tag = 0;
    Bytes data;
};

std::vector<Entry> entries_of(Bytes part, const std::string& path, std::uint64_t prefix = 0) {
    const BinaryView view(part, path);
    std::vector<Entry> entries;
    for (std::uint64_t at = prefix; at + kEntryHead <= view.size();) {
        const auto size = view.little<std::uint64_t>(at + 2);
        if (size > view.size() - at - kEntryHead) break;
        entries.push_back({view.little<std::uint16_t>(at), view.part(at + kEntryHead, size)});
        at += kEntryHead + size + prefix;
    }
    return entries;
}

/// The part at the end of a path of tags; empty where there is none.
Bytes find(Bytes part, std::initializer_list<std::uint16_t> tags, const std::string& path) {
    for (const std::uint16_t tag : tags) {
        Bytes found;
        for (const Entry& entry : entries_of(part, path))
            if (entry.tag == tag && found.empty()) found = entry.data;
        part = found;
    }
    return part;
}

/// A number at the end of a path. Throws where there is none of this size.
template <typename Number>
Number number(Bytes part, std::initializer_list<std::uint16_t> tags, const char* what,
              const std::string& path) {
    const Bytes found = find(part, tags, path);
    const BinaryView view(found, path);
    if (found.size() != sizeof(Number))
        view.refuse(fmt::format("the document has no {} where it is looked for", what));
    return view.little<Number>(0);
}

/// A byte 4, then 16-bit letters; those beyond Latin-1 become '?'.
std::string text(Bytes part) {
    std::string letters;
    for (std::size_t k = 1; k + 1 < part.size() && part[0] == std::byte{4}; k += 2)
        letters += part[k + 1] == std::byte{0} ? static_cast<char>(part[k]) : '?';
    return letters.substr(0, letters.find('\0'));
}

std::uint32_t class_of(Bytes object, const std::string& path) {
    const Bytes found = find(object, {1, 1}, path);
    return found.size() == 4 ? BinaryView(found, path).little<std::uint32_t>(0) : 0;
}

/// An array in blocks: u64 bytes, then u64 place, u32 items, u32 packed bytes, a zlib stream.
std::vector<std::byte> unpack(Bytes part, std::uint64_t item, const std::string& path) {
    const BinaryView view(part, path);
    const auto bytes = view.little<std::uint64_t>(0);
    if (bytes / kMostPacked > view.size())
        view.refuse(fmt::format("{} bytes do not fit {} packed ones", bytes, view.size()));
    std::vector<std::byte> all(static_cast<std::size_t>(bytes));
    std::uint64_t filled = 0;
    for (std::uint64_t at = 8; at < view.size();) {
        const auto place = view.little<std::uint64_t>(at);
        const std::uint64_t size = item * view.little<std::uint32_t>(at + 8);
        const std::uint64_t packed = view.little<std::uint32_t>(at + 12);
        if (place > bytes / item || size > bytes - place * item || filled + size > bytes)
            view.refuse(fmt::format("a block of {} bytes does not fit its array", size));
        const std::vector<std::byte> block = inflated(view.part(at + 16, packed), size, path);
        std::copy(block.begin(), block.end(),
                  all.begin() + static_cast<std::ptrdiff_t>(place * item));
        filled += size;
        at += 16 + packed;
    }
    if (filled != bytes) view.refuse(fmt::format("{} bytes of {} are there", filled, bytes));
    return all;
}

/// Step and unit of an axis: metres a step.
double step_of(Bytes scale, const std::string& path) {
    return number<double>(scale, {1}, "step", path) * metres_per(text(find(scale, {2}, path)));
}

/// A measured surface, in the bytes of the stream.
struct Measured {
    Bytes data;
    std::string name;
    std::uint64_t nx = 0, ny = 0;
    bool in_metres = false;
};

std::optional<Measured> measured(Bytes object, const std::string& path) {
    if (class_of(object, path) != kSurface) return std::nullopt;
    const Bytes inner = find(object, {2, 1}, path);
    if (class_of(inner, path) != kSurfaceData) return std::nullopt;
    Measured surface;
    surface.data = find(inner, {2, kBase}, path);
    surface.name = text(find(surface.data, {kBase, kBase, kBase, 1}, path));
    surface.nx =
        number<std::uint32_t>(surface.data, {kBase, 1, kBase, 1}, "number of columns", path);
    surface.ny = number<std::uint32_t>(surface.data, {kBase, 2, kBase, 1}, "number of rows", path);
    surface.in_metres = metres_per(text(find(surface.data, {2, kBase, 2}, path))) > 0;
    return surface;
}

void mark_missing(Topography& t, Bytes mask, const std::string& path) {
    const std::vector<std::byte> seen = unpack(find(mask, {2, 5, 2, 2}, path), 1, path);
    // A border of one point lies around
    const auto nx = static_cast<std::size_t>(t.nx), ny = static_cast<std::size_t>(t.ny);
    const BinaryView view(seen, path);
    if (seen.size() != (nx + 2) * (ny + 2))
        view.refuse(fmt::format("a mask of {} points does not fit", seen.size()));
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i)
            if (seen[(j + 1) * (nx + 2) + i + 1] != kMeasured) t.mark_missing(j * nx + i);
}

Topography read(const HeightsSource& source, Bytes data) {
    const std::string& path = source.path();
    const Bytes x = find(data, {kBase, 1, kBase}, path), y = find(data, {kBase, 2, kBase}, path),
                z = find(data, {2, kBase}, path), array = find(data, {1, 2}, path);
    const std::uint64_t nx = number<std::uint32_t>(x, {1}, "number of columns", path),
                        ny = number<std::uint32_t>(y, {1}, "number of rows", path);
    check_sides(nx, ny, path);
    const Bytes blocks = find(array, {2}, path);
    const auto bytes = BinaryView(blocks, path).little<std::uint64_t>(0);
    if (bytes != nx * ny * 2 && bytes != nx * ny * 4)
        source.refuse(fmt::format("{} bytes are no {} x {} heights", bytes, nx, ny));
    const std::uint64_t item = bytes / (nx * ny);
    const std::vector<std::byte> counts = unpack(blocks, item, path);

    GridNumbers numbers;
    numbers.type = item == 2 ? NumberType::I16 : NumberType::I32;
    numbers.scale = step_of(z, path);
    const Bytes shown = find(z, {3}, path), origin = find(z, {5}, path);
    if (origin.size() == sizeof(double))
        numbers.offset = BinaryView(origin, path).little<double>(0) *
                         metres_per(text(shown.empty() ? find(z, {2}, path) : shown));
    if (!std::isfinite(numbers.scale) || numbers.scale == 0 || !std::isfinite(numbers.offset))
        source.refuse("the height of a count is no length");
    Topography t = read_grid(source, BinaryView(counts, path), nx, ny, numbers, never_missing);
    if (const Bytes mask = find(data, {kBase, 3}, path); class_of(mask, path) == kMask)
        mark_missing(t, mask, path);
    set_spacing(t, step_of(find(x, {kBase}, path), path), step_of(find(y, {kBase}, path), path),
                fmt::format("steps of {}", length_text(std::abs(numbers.scale))), path);
    t.note("first row on top");
    t.note("as it was measured: what Mountains made of it is not in the file");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    if (!is_compound_file(source.head())) view.refuse("not a Mountains document (wrong magic)");
    const auto stream = std::make_shared<const std::vector<std::byte>>(
        read_compound_stream(view, "ScopedContents"));
    const Bytes tree = Bytes(*stream).subspan(std::min<std::size_t>(8, stream->size()));
    const Bytes list = find(tree, {1, 0x2bd, 2, 1}, source.path());
    std::vector<HeightsChannel> channels;
    for (const Entry& entry : entries_of(list, source.path(), 8)) {
        const auto surface = measured(entry.data, source.path());
        if (!surface) continue;
        channels.push_back({surface->name.empty() ? "surface" : surface->name, surface->nx,
                            surface->ny, surface->in_metres ? "" : "in no unit of length",
                            [source, stream, data = surface->data] { return read(source, data); }});
    }
    return channels;
}

}  // namespace

HeightsFormat mnt_format() {
    return {"mnt",
            {"mnt"},
            "Digital Surf Mountains .mnt: the surfaces as they were measured",
            is_compound_file,
            open,
            nullptr};
}

}  // namespace asperity::io
