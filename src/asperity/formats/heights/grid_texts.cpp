// SPDX-License-Identifier: Apache-2.0
// Grids in text whose headers have fixed words: ESRI's .asc and SPIP's .asc.
#include <asperity/core/parse_number.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/text_table.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

namespace asperity::io {
namespace {

using Words = std::map<std::string, std::string>;

std::string small(std::string_view text) {
    std::string copy(text);
    for (char& c : copy)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return copy;
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return trimmed(text);
}

double number(const Words& words, const std::string& key, double otherwise,
              const HeightsSource& source) {
    const auto found = words.find(key);
    if (found == words.end()) return otherwise;
    const auto value = table_number(found->second, true);
    if (!value)
        source.refuse(
            fmt::format("{} {} in the header is not a number", key, in_quotes(found->second)));
    return *value;
}

std::uint64_t count(const Words& words, const std::string& key, const HeightsSource& source) {
    const auto found = words.find(key);
    if (found == words.end()) source.refuse(key + " is missing in the header");
    const auto value = parse_integer<std::uint64_t>(found->second);
    if (!value)
        source.refuse(fmt::format("{} {} is no number of samples", key, in_quotes(found->second)));
    return *value;
}

// nx x ny numbers, wherever the lines end; those equal to `gone` are missing.
Topography fill(TextTable table, std::uint64_t nx, std::uint64_t ny, double gone,
                const HeightsSource& source) {
    if (table.numbers.size() / nx != ny || table.numbers.size() % nx != 0)
        source.refuse(fmt::format("the header announces {} x {} numbers, {} are found", nx, ny,
                                  table.numbers.size()));
    Topography t;
    t.nx = static_cast<int>(nx), t.ny = static_cast<int>(ny);
    t.heights = std::move(table.numbers);
    for (std::size_t k = 0; k < t.heights.size(); ++k) {
        if (!std::isnan(t.heights[k]) && t.heights[k] != gone) continue;
        t.heights[k] = 0;
        t.mark_missing(k);
    }
    if (table.decimal_comma) t.note("decimal commas");
    return t;
}

// ------------------------------------------------------------------------------------------ ESRI

bool recognises_esri(std::string_view head) {
    return small(without_mark(head).substr(0, 5)) == "ncols";
}

Words esri_words(const TextTable& table) {
    Words words;
    for (const TextLine& line : table.header) {
        if (line.comment) continue;
        const std::size_t gap = std::min(line.text.find_first_of(" \t"), line.text.size());
        words[small(line.text.substr(0, gap))] = std::string(trimmed(line.text).substr(gap));
    }
    for (auto& [key, value] : words) value = std::string(trimmed(value));
    return words;
}

Topography read_esri(const HeightsSource& source) {
    TextTable table = read_text_table(source, true);
    const Words words = esri_words(table);
    const std::uint64_t nx = count(words, "ncols", source), ny = count(words, "nrows", source);
    check_sides(nx, ny, source.path());
    const double gone = number(words, "nodata_value", -9999, source);
    const double cell = number(words, "cellsize", 0, source);
    const double dx = number(words, "dx", cell, source), dy = number(words, "dy", cell, source);
    if (!(dx > 0 && dy > 0) || !std::isfinite(dx) || !std::isfinite(dy))
        source.refuse("the header has no cellsize above 0");
    Topography t = fill(std::move(table), nx, ny, gone, source);
    t.dx = dx, t.dy = dy;
    t.note(fmt::format("spacing {:.6g} from the header", dx));
    t.note("first row on top");
    t.assume("heights are in the unit of the spacing");
    return t;
}

// ------------------------------------------------------------------------------------------ SPIP

bool recognises_spip(std::string_view head) {
    head = without_mark(head);
    return head.starts_with("# File Format = ASCII") ||
           (head.starts_with('#') && head.find("x-pixels") != std::string_view::npos &&
            head.find("x-length") != std::string_view::npos);
}

Topography read_spip(const HeightsSource& source) {
    TextTable table = read_text_table(source, true);
    Words words;
    for (const TextLine& line : table.header) {
        const std::size_t equals = line.text.find('=');
        if (equals == std::string::npos) continue;
        words[small(trimmed(std::string_view(line.text).substr(0, equals)))] =
            std::string(trimmed(std::string_view(line.text).substr(equals + 1)));
    }
    const std::uint64_t nx = count(words, "x-pixels", source),
                        ny = count(words, "y-pixels", source);
    check_sides(nx, ny, source.path());
    const double gone =
        number(words, "voidpixels", 0, source) == 0
            ? std::numeric_limits<double>::quiet_NaN()
            : number(words, "void value", std::numeric_limits<double>::quiet_NaN(), source);
    Topography t = fill(std::move(table), nx, ny, gone, source);
    const double bit = number(words, "bit2nm", 1, source);
    for (double& h : t.heights) h *= bit * 1e-9;
    const double width = number(words, "x-length", 0, source),
                 height = number(words, "y-length", 0, source);
    set_spacing(t, width * 1e-9 / t.nx, height * 1e-9 / t.ny,
                words.contains("bit2nm") ? fmt::format("steps of {:.6g} nm", bit) : "nm",
                source.path());
    t.note("first row on top");
    return t;
}

}  // namespace

HeightsFormat esri_format() {
    return {"esri",
            {},
            "ESRI grid .asc: ncols, nrows, cellsize, NODATA_value",
            recognises_esri,
            open_one<read_esri>,
            nullptr};
}

HeightsFormat spip_format() {
    return {"spip",
            {},
            "SPIP .asc: pixels, lengths in nm, Bit2nm",
            recognises_spip,
            open_one<read_spip>,
            nullptr};
}

}  // namespace asperity::io
