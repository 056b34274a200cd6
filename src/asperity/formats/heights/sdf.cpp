// SPDX-License-Identifier: Apache-2.0
// SDF (ISO 25178-71): a header of 81 bytes and numbers, or both as text. Lengths in m.
#include <asperity/core/parse_number.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <algorithm>
#include <limits>
#include <map>

namespace asperity::io {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Header {
    std::uint64_t points = 0, profiles = 0;
    double x = 0, y = 0, z = 0;  ///< [m]
    int compression = 0, type = 0, check = 0;
};

constexpr std::pair<NumberType, double> kTypes[] = {
    // with the number that is missing
    {NumberType::U8, kNaN},           {NumberType::U16, 65535}, {NumberType::U32, 4294967295.0},
    {NumberType::F32, kNaN},          {NumberType::I8, kNaN},   {NumberType::I16, -32768},
    {NumberType::I32, -2147483648.0}, {NumberType::F64, kNaN},
};

bool is_text(std::string_view head) {
    return head.starts_with("aISO-1.0") || head.starts_with("aBCR-1.0");
}

bool recognises(std::string_view head) {
    return is_text(head) || head.starts_with("bISO-1.0") || head.starts_with("bBCR-1.0");
}

void finish(Topography& t, const Header& header, const HeightsSource& source) {
    set_spacing(t, header.x, header.y, "steps of " + length_text(header.z), source.path());
    t.note("first profile on top");
}

void check(const Header& header, const HeightsSource& source) {
    if (header.compression != 0) source.refuse("compressed SDF files are not read");
    if (header.type < 0 || header.type > 7)
        source.refuse(fmt::format("the data type {} is none of 0 to 7", header.type));
    if (!std::isfinite(header.z) || header.z == 0)
        source.refuse(fmt::format("a Zscale of {:.6g} m is no length", header.z));
    check_sides(header.points, header.profiles, source.path());
}

Header binary_header(const HeightsSource& source) {
    const BinaryView view(source.bytes(), source.path());
    view.need(0, 81);
    Header header;
    header.points = view.little<std::uint16_t>(42);
    header.profiles = view.little<std::uint16_t>(44);
    header.x = view.little<double>(46);
    header.y = view.little<double>(54);
    header.z = view.little<double>(62);
    header.compression = view.little<std::uint8_t>(78);
    header.type = view.little<std::uint8_t>(79);
    check(header, source);
    return header;
}

Topography read_binary(const HeightsSource& source) {
    const Header header = binary_header(source);
    const auto [type, gone] = kTypes[header.type];
    const BinaryView view(source.bytes(), source.path());
    Topography t =
        read_grid(source, view, header.points, header.profiles, {type, false, 81, 0, header.z, 0},
                  [gone = gone](double n) { return n == gone; });
    finish(t, header, source);
    return t;
}

std::string small(std::string_view text) {
    std::string copy(text);
    for (char& c : copy)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return copy;
}

/// Lines "key = value" up to "*"; leaves `text` behind that line.
std::map<std::string, std::string> text_header(std::string_view& text,
                                               const HeightsSource& source) {
    std::map<std::string, std::string> words;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view entry = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (entry == "*") return words;
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos) {
            if (line == 1 || entry.empty()) continue;
            source.refuse_line(line, in_quotes(entry) + " is no 'key = value'");
        }
        words[small(trimmed(entry.substr(0, equals)))] = trimmed(entry.substr(equals + 1));
    }
    source.refuse("the header is not ended by '*'");
}

Header parse_header(const std::map<std::string, std::string>& words, const HeightsSource& source) {
    const auto number = [&](const char* key) {
        const auto found = words.find(key);
        if (found == words.end()) source.refuse(fmt::format("{} is missing in the header", key));
        const auto value = parse_double(found->second);
        if (!value)
            source.refuse(fmt::format("{} {} is not a number", key, in_quotes(found->second)));
        return *value;
    };
    const auto whole = [&](const char* key, double most) {
        const double value = number(key);
        if (!(value >= 0 && value <= most) || value != std::floor(value))
            source.refuse(fmt::format("{} {} is no whole number up to {}", key, value, most));
        return value;
    };
    Header header;
    header.points = static_cast<std::uint64_t>(whole("numpoints", 1e9));
    header.profiles = static_cast<std::uint64_t>(whole("numprofiles", 1e9));
    header.x = number("xscale");
    header.y = number("yscale");
    header.z = number("zscale");
    if (words.contains("compression"))
        header.compression = static_cast<int>(whole("compression", 255));
    header.type = static_cast<int>(whole("datatype", 255));
    check(header, source);
    return header;
}

Topography read_text(const HeightsSource& source) {
    std::string_view text = source.text();
    const Header header = parse_header(text_header(text, source), source);
    // A number takes two bytes at least.
    if (header.points * header.profiles > text.size())
        source.refuse(fmt::format("{} x {} numbers do not fit {} bytes", header.points,
                                  header.profiles, text.size()));
    Topography t = empty_topography(header.points, header.profiles, source.path());
    const double gone = kTypes[header.type].second;
    source.for_each_row(t.ny, [&](int j) {
        for (int i = 0; i < t.nx; ++i) {
            const std::size_t k =
                static_cast<std::size_t>(j) * header.points + static_cast<std::size_t>(i);
            text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n,;"), text.size()));
            const std::size_t end = std::min(text.find_first_of(" \t\r\n,;"), text.size());
            const std::string_view word = text.substr(0, end);
            text.remove_prefix(end);
            const bool bad = word == "BAD" || word == "NaN" || word == "nan";
            const auto value = bad ? std::optional(kNaN) : parse_double(word);
            if (!value)
                source.refuse(fmt::format("value {} of profile {}: {} is not a number", i + 1,
                                          j + 1, in_quotes(word)));
            if (std::isnan(*value) || *value == gone)
                t.mark_missing(k);
            else
                t.heights[k] = *value * header.z;
        }
    });
    if (!trimmed(text).empty() && !trimmed(text).starts_with('*'))
        source.refuse("more numbers follow than the header announces");
    finish(t, header, source);
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    if (!recognises(source.head())) source.refuse("not an SDF file (wrong magic)");
    if (!is_text(source.head())) {
        const Header header = binary_header(source);
        return {{"heights", header.points, header.profiles, {}, [source] {
                     return read_binary(source);
                 }}};
    }
    std::string_view text = source.text();
    const Header header = parse_header(text_header(text, source), source);
    return {
        {"heights", header.points, header.profiles, {}, [source] { return read_text(source); }}};
}

}  // namespace

HeightsFormat sdf_format() {
    return {"sdf", {"sdf"}, "SDF (ISO 25178-71), binary and text", recognises, open, nullptr};
}

}  // namespace asperity::io
