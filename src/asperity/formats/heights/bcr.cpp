// SPDX-License-Identifier: Apache-2.0
// SPIP's and others' .bcr and .bcrf: a text header of a fixed number of characters, 8 or 16 bits
// each, then 16-bit integers (bcrstm) or 32-bit floats (bcrf), the first row on top.
#include <asperity/core/length.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <map>

namespace asperity::io {
namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t kLeastHeader = 2048;  ///< characters, also where none are told
constexpr double kVoidCount = 32767, kVoidFloat = 1.7e38;

/// How the characters of the header are stored.
struct Letters {
    std::uint64_t bytes = 1;
    bool big_endian = false;
    std::uint64_t mark = 0;  ///< bytes of a byte order mark
};

Letters letters_of(std::string_view head) {
    if (head.starts_with("\xff\xfe")) return {2, false, 2};
    if (head.starts_with("\xfe\xff")) return {2, true, 2};
    if (head.starts_with("f\0i\0"sv)) return {2, false, 0};
    return {};
}

/// The header as Latin-1; other letters become '?'.
std::string latin(std::string_view bytes, const Letters& letters) {
    if (letters.bytes == 1) return std::string(bytes);
    std::string text;
    for (std::size_t k = letters.mark; k + 1 < bytes.size(); k += 2) {
        const char low = bytes[k + (letters.big_endian ? 1 : 0)];
        text += bytes[k + (letters.big_endian ? 0 : 1)] == '\0' ? low : '?';
    }
    return text;
}

bool recognises(std::string_view head) {
    std::string text = latin(head.substr(0, 128), letters_of(head));
    constexpr std::string_view kKey = "fileformat";
    if (!text.starts_with(kKey)) return false;
    const std::size_t equals = text.find_first_not_of(" \t", kKey.size());
    if (equals == std::string::npos || text[equals] != '=') return false;
    return trimmed(std::string_view(text).substr(equals + 1)).starts_with("bcr");
}

class Header {
  public:
    explicit Header(const HeightsSource& source) : source_(source) {
        if (!recognises(source.head())) source.refuse("not a BCR file (no fileformat = bcr...)");
        const Letters letters = letters_of(source.head());
        const BinaryView view(source.bytes(), source.path());
        read(source.text().substr(0, kLeastHeader * letters.bytes), letters);
        const std::uint64_t characters = count("headersize", kLeastHeader);
        view.need(0, characters, letters.bytes);
        data = characters * letters.bytes;
        read(source.text().substr(0, data), letters);
        const std::string format = words_["fileformat"];
        if (format != "bcrstm" && format != "bcrstm_unicode" && format != "bcrf" &&
            format != "bcrf_unicode")
            source.refuse("the file format " + in_quotes(format) + " is neither bcrstm nor bcrf");
        floats = format.starts_with("bcrf");
    }

    std::uint64_t count(const std::string& key, std::optional<std::uint64_t> otherwise) const {
        const auto found = words_.find(key);
        if (found == words_.end() && otherwise) return *otherwise;
        const std::string word = found == words_.end() ? "" : found->second;
        const auto value = parse_integer<std::uint64_t>(word);
        if (!value) source_.refuse(key + " " + in_quotes(word) + " is no whole number");
        return *value;
    }

    double number(const std::string& key, double otherwise) const {
        const auto found = words_.find(key);
        if (found == words_.end()) return otherwise;
        const auto value = parse_double(found->second);
        if (!value) source_.refuse(key + " " + in_quotes(found->second) + " is not a number");
        return *value;
    }

    /// Nanometres unless the file says otherwise, as the format has it.
    std::string unit(const std::string& key) const {
        const auto found = words_.find(key);
        return found == words_.end() || found->second.empty() ? "nm" : found->second;
    }

    bool has(const std::string& key) const { return words_.contains(key); }

    std::uint64_t data = 0;  ///< first byte of the samples
    bool floats = false;

  private:
    void read(std::string_view bytes, const Letters& letters) {
        words_.clear();
        const std::string text = latin(bytes, letters);
        for (std::string_view line : split(text, '\n')) {
            const std::size_t equals = line.find('=');
            if (line.starts_with('%') || line.starts_with('#') || equals == line.npos) continue;
            words_.emplace(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
        }
    }

    const HeightsSource& source_;
    std::map<std::string, std::string> words_;
};

double metres(const Header& header, const std::string& key, const HeightsSource& source) {
    const double unit = metres_per(header.unit(key));
    if (unit == 0) source.refuse(key + " " + in_quotes(header.unit(key)) + " is no unit of length");
    return unit;
}

Topography read(const HeightsSource& source) {
    const Header header(source);
    const BinaryView view(source.bytes(), source.path());
    const std::uint64_t nx = header.count("xpixels", {}), ny = header.count("ypixels", {});
    GridNumbers numbers;
    numbers.type = header.floats ? NumberType::F32 : NumberType::I16;
    numbers.big_endian = header.number("intelmode", 1) == 0;
    numbers.at = header.data;
    const double bit = header.floats ? 1 : header.number("bit2nm", 1);
    numbers.scale = bit * metres(header, "zunit", source);
    if (!std::isfinite(numbers.scale) || numbers.scale == 0)
        source.refuse("the height of a count is no length");
    Topography t = read_grid(source, view, nx, ny, numbers, [&](double n) {
        return header.floats ? n > kVoidFloat : n == kVoidCount;
    });
    set_spacing(
        t, header.number("xlength", 0) * metres(header, "xunit", source) / static_cast<double>(nx),
        header.number("ylength", 0) * metres(header, "yunit", source) / static_cast<double>(ny),
        header.floats ? header.unit("zunit")
                      : fmt::format("steps of {}", length_text(numbers.scale)),
        source.path());
    t.note("first row on top");
    if (!header.floats && !header.has("bit2nm")) t.assume("no bit2nm in the file: a count is 1");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    const Header header(source);
    const std::string z = header.unit("zunit");
    return {{"heights", header.count("xpixels", {}), header.count("ypixels", {}),
             metres_per(z) > 0 ? "" : "in " + in_quotes(z), [source] { return read(source); }}};
}

}  // namespace

HeightsFormat bcr_format() {
    return {
        "bcr", {"bcr", "bcrf"}, "SPIP .bcr, .bcrf: 16-bit integers or 32-bit floats", recognises,
        open,  nullptr};
}

}  // namespace asperity::io
