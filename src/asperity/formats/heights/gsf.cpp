// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace asperity::io {

static_assert(std::endian::native == std::endian::little, "GSF numbers are little-endian");

namespace {

constexpr std::string_view kMagic = "Gwyddion Simple Field 1.0\n";
constexpr std::uint64_t kMaxHeaderBytes = 1 << 20;
constexpr std::size_t kAlignment = 4;

// A cell size of ours is believed when it agrees with XReal / XRes, which others may have edited.
constexpr double kCellTolerance = 1e-9;

struct Header {
    std::map<std::string, std::string> values;
    std::map<std::string, int> lines;  ///< of each key, from 1
    std::uint64_t bytes = 0;           ///< with its NULs
};

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
    throw Error(ErrorCode::InvalidInput, why, where);
}

// Lines `key = value` between the magic line and the first NUL.
Header parse_header(std::string_view text, const std::string& path) {
    Header header;
    int line = 1;
    text.remove_prefix(kMagic.size());
    while (!text.empty()) {
        ++line;
        const std::string where = fmt::format("{}:{}", path, line);
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) refuse(where, "the header does not end with a line end");
        const std::string_view entry = text.substr(0, end);
        text.remove_prefix(end + 1);
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos)
            refuse(where, in_quotes(entry) + " is no 'key = value'");
        const std::string key(trimmed(entry.substr(0, equals)));
        if (!header.values.emplace(key, trimmed(entry.substr(equals + 1))).second)
            refuse(where, in_quotes(key) + " is given twice");
        header.lines[key] = line;
    }
    return header;
}

Header read_header(const InputFile& file) {
    std::string start(static_cast<std::size_t>(std::min(file.size(), kMaxHeaderBytes)), ' ');
    file.read(0, std::as_writable_bytes(std::span(start)));
    if (!start.starts_with(kMagic)) refuse(file.path(), "not a GSF file (wrong magic)");
    const std::size_t end = start.find('\0');
    if (end == std::string::npos) refuse(file.path(), "the GSF header is not ended by a NUL byte");
    Header header = parse_header(std::string_view(start).substr(0, end), file.path());

    // 1 to 4 NULs, so that the samples begin at a multiple of 4.
    const std::size_t padding = kAlignment - end % kAlignment;
    if (start.size() < end + padding ||
        start.compare(end, padding, std::string(padding, '\0')) != 0)
        refuse(file.path(),
               fmt::format("{} NUL bytes must follow the header of {} bytes", padding, end));
    header.bytes = end + padding;
    return header;
}

class HeaderReader {
  public:
    HeaderReader(const Header& header, const std::string& path) : header_(header), path_(path) {}

    std::optional<std::string> text(const std::string& key) const {
        const auto found = header_.values.find(key);
        return found == header_.values.end() ? std::nullopt : std::optional(found->second);
    }

    std::uint64_t resolution(const std::string& key) const {
        const auto value = text(key);
        if (!value) refuse(path_, key + " is missing in the GSF header");
        const auto number = parse_integer<std::uint64_t>(*value);
        if (!number || *number == 0) fail(key, "is no number of samples");
        return *number;
    }

    std::optional<double> length(const std::string& key) const {
        const auto value = text(key);
        if (!value) return std::nullopt;
        const auto number = parse_double(*value);
        if (!number || *number <= 0) fail(key, "is no positive length");
        return number;
    }

    template <typename Value>
    std::optional<Value> choice(const std::string& key, const char* first, Value first_value,
                                const char* second, Value second_value) const {
        const auto value = text(key);
        if (!value) return std::nullopt;
        if (*value == first) return first_value;
        if (*value != second) fail(key, fmt::format("is neither {} nor {}", first, second));
        return second_value;
    }

    // Metres per unit; nothing when there is no unit.
    std::optional<double> metres(const std::string& key) const {
        const auto value = text(key);
        if (!value || value->empty()) return std::nullopt;
        constexpr std::array<std::pair<const char*, double>, 9> kUnits = {{
            {"m", 1},
            {"cm", 1e-2},
            {"mm", 1e-3},
            {"um", 1e-6},
            {"\xc2\xb5m", 1e-6},
            {"\xce\xbcm", 1e-6},
            {"nm", 1e-9},
            {"pm", 1e-12},
            {"km", 1e3},
        }};
        for (const auto& [unit, length] : kUnits)
            if (*value == unit) return length;
        fail(key, "is no unit of length known here (m, cm, mm, um, nm, pm)");
    }

    [[noreturn]] void fail(const std::string& key, const std::string& why) const {
        refuse(fmt::format("{}:{}", path_, header_.lines.at(key)),
               fmt::format("{} {} {}", key, in_quotes(*text(key)), why));
    }

  private:
    const Header& header_;
    const std::string& path_;
};

double spacing(const HeaderReader& header, const std::string& axis, int samples) {
    const double from_size = header.length(axis + "Real").value_or(1.0) / samples;
    const auto exact = header.length("AsperityCell" + axis);
    return exact && std::abs(*exact - from_size) <= kCellTolerance * from_size ? *exact : from_size;
}

// Brings widths and heights to metres, or leaves both without unit.
void apply_units(const HeaderReader& header, Heightfield& surface, const std::string& path) {
    const auto width = header.metres("XYUnits"), height = header.metres("ZUnits");
    if (!width && !height) return;
    if (!width || !height)
        refuse(path, fmt::format("only one of XYUnits and ZUnits is given: widths and heights need "
                                 "the same kind of unit"));
    surface.unit = "m";
    surface.dx *= *width;
    surface.dy *= *width;
    if (*height == 1) return;
    for (float& h : surface.heights) h = static_cast<float>(static_cast<double>(h) * *height);
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return std::string(trimmed(text));
}

}  // namespace

Topography read_gsf(const HeightsSource& source) {
    const std::string& path = source.path();
    const InputFile file(path);
    const Header lines = read_header(file);
    const HeaderReader header(lines, path);

    // The samples must fill the rest of the file.
    const std::uint64_t nx = header.resolution("XRes"), ny = header.resolution("YRes");
    check_sides(nx, ny, path);
    const std::uint64_t expected = lines.bytes + nx * ny * sizeof(float);
    if (expected != file.size())
        refuse(path, fmt::format("{} x {} samples need {} bytes, the file has {}", nx, ny, expected,
                                 file.size()));
    Heightfield surface = empty_patch(nx, ny, path);
    const auto samples = std::as_writable_bytes(std::span(surface.heights));
    const std::size_t row_bytes = samples.size() / static_cast<std::size_t>(surface.ny);
    source.for_each_row(surface.ny, [&](int j) {
        const std::size_t at = static_cast<std::size_t>(j) * row_bytes;
        file.read(lines.bytes + at, samples.subspan(at, row_bytes));
    });

    surface.dx = spacing(header, "X", surface.nx);
    surface.dy = spacing(header, "Y", surface.ny);
    apply_units(header, surface, path);
    if (const auto title = header.text("Title"); title && !title->empty()) surface.name = *title;
    surface.diagonal =
        header.choice("AsperityDiagonal", "anti", Diagonal::Anti, "main", Diagonal::Main)
            .value_or(surface.diagonal);
    surface.boundary =
        header
            .choice("AsperityBoundary", "periodic", Boundary::Periodic, "finite", Boundary::Finite)
            .value_or(surface.boundary);
    surface.isotropic = header.choice("AsperityIsotropic", "true", true, "false", false)
                            .value_or(surface.isotropic);
    Topography topography = as_topography(surface);
    topography.ours = header.text("AsperityBoundary").has_value();
    topography.found = header.text("AsperitySource").value_or("");
    topography.prepared = header.text("AsperityPrepared").value_or("");
    return topography;
}

void write_gsf(const Heightfield& surface, const std::string& path) {
    std::string header(kMagic);
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) header += fmt::format("{} = {}\n", key, value);
    };
    add("XRes", std::to_string(surface.nx));
    add("YRes", std::to_string(surface.ny));
    add("XReal", shortest(surface.dx * surface.nx));
    add("YReal", shortest(surface.dy * surface.ny));
    if (surface.unit == "m") {
        add("XYUnits", "m");
        add("ZUnits", "m");
    }
    add("Title", one_line(surface.name));
    add("AsperityDiagonal", surface.diagonal == Diagonal::Anti ? "anti" : "main");
    add("AsperityBoundary", surface.boundary == Boundary::Periodic ? "periodic" : "finite");
    add("AsperityIsotropic", surface.isotropic ? "true" : "false");
    add("AsperityCellX", shortest(surface.dx));
    add("AsperityCellY", shortest(surface.dy));
    add("AsperitySource", one_line(surface.source));
    add("AsperityPrepared", one_line(surface.prepared));
    header.append(kAlignment - header.size() % kAlignment, '\0');

    AtomicFile file(path);
    file.write(header);
    file.write(std::as_bytes(std::span(surface.heights)));
    file.commit();
}

}  // namespace asperity::io
