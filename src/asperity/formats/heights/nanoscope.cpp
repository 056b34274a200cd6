// SPDX-License-Identifier: Apache-2.0
// Bruker's, Veeco's and Digital Instruments' Nanoscope files (.spm, .001, .di), version 4.3 and
// later: a text header of sections, then integers of each image, the bottom line first.
//
// A height is count x hard scale / 256^bytes x soft scale: the hard scale [V] stands in the image's
// "@2:Z scale", the soft one [nm/V] in the list of the scanner or of the scan, under the name in
// the hard one's brackets.
#include <asperity/core/length.h>
#include <asperity/formats/heights/builtin_heights.h>
#include <asperity/formats/heights/grid_reader.h>

#include <map>

namespace asperity::io {
namespace {

constexpr std::string_view kMagic = "\\*File list", kMagicForce = "\\*Force file list";
constexpr std::uint64_t kMostHeader = 1 << 20;
constexpr std::uint64_t kWideVersion = 0x09200000;  ///< 32-bit samples whatever the header says
constexpr std::size_t kMostSections = 1000;

using Words = std::map<std::string, std::string>;

struct Section {
    std::string name;
    Words words;
};

std::string small(std::string_view text) {
    std::string lower(trimmed(text));
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

bool recognises(std::string_view head) {
    return head.starts_with(kMagic) || head.starts_with(kMagicForce);
}

std::vector<Section> read_sections(const HeightsSource& source) {
    if (!recognises(source.head())) source.refuse("not a Nanoscope file (no \\*File list)");
    std::string_view text = source.text().substr(0, kMostHeader);
    const std::size_t end = text.find("\\*File list end");
    if (end == text.npos) source.refuse("the header has no \\*File list end");
    std::vector<Section> sections;
    for (std::string_view line : split(text.substr(0, end), '\n')) {
        if (line.starts_with("\\*")) {
            if (sections.size() == kMostSections) source.refuse("too many sections");
            sections.push_back({small(line.substr(2)), {}});
        } else if (line.starts_with('\\')) {
            const std::size_t colon = std::min(line.find(": "), line.size());
            // The colon of "@2:Z scale" has no blank behind it
            sections.back().words[small(line.substr(1, colon - 1))] =
                trimmed(line.substr(std::min(colon + 1, line.size())));
        }
    }
    return sections;
}

std::string word(const Words& words, const std::string& key) {
    const auto found = words.find(key);
    return found == words.end() ? "" : found->second;
}

std::uint64_t count(const Words& words, const std::string& key, const HeightsSource& source) {
    const auto value = parse_integer<std::uint64_t>(word(words, key));
    if (!value)
        source.refuse(in_quotes(key) + " " + in_quotes(word(words, key)) + " is no whole number");
    return *value;
}

struct Quantity {
    double value = 0;
    std::string unit;
};

std::optional<Quantity> quantity(std::string_view text) {
    text = trimmed(text);
    const std::size_t gap = std::min(text.find_first_of(" \t"), text.size());
    const auto value = parse_double(text.substr(0, gap));
    if (!value) return std::nullopt;
    return Quantity{*value, std::string(trimmed(text.substr(gap)))};
}

/// "V [Sens. Zsens] (0.0067 V/LSB) 2.91 V": what stands in the brackets, and the end.
struct Scale {
    std::string soft;
    std::optional<Quantity> hard;
};

Scale scale_of(std::string_view text) {
    Scale scale;
    text = trimmed(text);
    text.remove_prefix(std::min<std::size_t>(1, text.size()));
    text = trimmed(text);
    if (text.starts_with('[')) {
        const std::size_t close = text.find(']');
        if (close == text.npos) return scale;
        scale.soft = trimmed(text.substr(1, close - 1));
        text = trimmed(text.substr(close + 1));
    }
    if (text.starts_with('(')) {
        // A unit may have brackets of its own
        std::size_t at = 0;
        for (int depth = 0; at < text.size(); ++at) {
            depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
            if (depth == 0) break;
        }
        text = trimmed(text.substr(std::min(at + 1, text.size())));
    }
    scale.hard = quantity(text);
    return scale;
}

/// "~m" is how the maker writes micrometres.
double metres(std::string_view unit) {
    return unit == "~m" ? 1e-6 : metres_per(unit);
}

/// 1e-3 of "mV", when the rest of the two is alike; else 0.
double ratio(std::string_view from, std::string_view to) {
    if (from == to) return 1;
    if (from.size() == to.size() + 1 && from.ends_with(to))
        return from[0] == 'm' ? 1e-3 : from[0] == 'k' ? 1e3 : 0;
    if (to.size() == from.size() + 1 && to.ends_with(from))
        return to[0] == 'm' ? 1e3 : to[0] == 'k' ? 1e-3 : 0;
    return 0;
}

struct Image {
    std::string name, other;
    std::uint64_t at = 0, nx = 0, ny = 0;
    NumberType type = NumberType::I16;
    double step = 0;               ///< metres a count
    double width = 0, height = 0;  ///< metres
};

class File {
  public:
    explicit File(const HeightsSource& source) : source_(source), sections_(read_sections(source)) {
        for (const Section& section : sections_)
            for (const auto& [key, value] : section.words)
                if (!section.name.ends_with("image list")) common_.emplace(key, value);
        if (word(common_, "operating mode") == "Force" || word(common_, "start context") == "FOL")
            source.refuse("force curves, not a surface");
    }

    std::vector<Image> images() const {
        std::vector<Image> images;
        for (const Section& section : sections_)
            if (section.name.ends_with("image list")) images.push_back(image(section.words));
        return images;
    }

  private:
    Image image(const Words& words) const {
        Image image;
        image.name = scale_of(word(words, "@2:image data")).soft;
        if (image.name.empty()) image.name = "image";
        image.at = count(words, "data offset", source_);
        image.nx = count(words, "samps/line", source_);
        image.ny = count(words, "number of lines", source_);
        const std::uint64_t bytes =
            words.contains("bytes/pixel") ? count(words, "bytes/pixel", source_) : 2;
        if (bytes != 2 && bytes != 4)
            source_.refuse(fmt::format("samples of {} bytes are not known", bytes));
        const std::uint64_t length = count(words, "data length", source_);
        const bool wide = bytes == 4 || (version() >= kWideVersion && image.nx > 0 &&
                                         image.ny > 0 && length / 4 / image.nx >= image.ny);
        image.type = wide ? NumberType::I32 : NumberType::I16;
        set_size(image, words);
        set_step(image, words, bytes == 2 ? 65536.0 : 4294967296.0);
        return image;
    }

    std::uint64_t version() const {
        const std::string text = word(common_, "version");
        std::uint64_t value = 0;
        if (text.starts_with("0x"))
            std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
        return value;
    }

    /// "10 10 ~m", or one number for both sides; the length of the slow axis has a word of its own
    /// in later files.
    void set_size(Image& image, const Words& words) const {
        const auto first = quantity(word(words, "scan size"));
        if (!first) source_.refuse("the scan size is missing");
        Quantity second = quantity(first->unit).value_or(*first);
        image.width = first->value * metres(second.unit);
        image.height = second.value * metres(second.unit);
        const auto fast = quantity(word(common_, "scan size")),
                   slow = quantity(word(common_, "slow axis size"));
        if (!fast || !slow) return;
        image.width = fast->value * metres(fast->unit);
        image.height = slow->value * metres(slow->unit);
    }

    void set_step(Image& image, const Words& words, double full) const {
        const Scale z = scale_of(word(words, "@2:z scale"));
        if (!z.hard) {
            image.other = "no @2:Z scale, as in files before version 4.3";
            return;
        }
        const Scale soft = scale_of(word(common_, small("@" + z.soft)));
        image.other = "in " + in_quotes(z.hard->unit);
        if (!soft.hard) return;
        const std::size_t stroke = std::min(soft.hard->unit.find('/'), soft.hard->unit.size());
        const std::string unit = soft.hard->unit.substr(0, stroke);
        const std::string per =
            soft.hard->unit.substr(std::min(stroke + 1, soft.hard->unit.size()));
        if (!unit.empty()) image.other = "in " + in_quotes(unit);
        image.step =
            z.hard->value / full * ratio(z.hard->unit, per) * soft.hard->value * metres(unit);
        if (image.step != 0 && std::isfinite(image.step)) image.other.clear();
    }

    const HeightsSource& source_;
    std::vector<Section> sections_;
    Words common_;
};

Topography read(const HeightsSource& source, const Image& image) {
    const BinaryView view(source.bytes(), source.path());
    Topography t = read_grid(source, view, image.nx, image.ny,
                             {image.type, false, image.at, 0, image.step, 0}, never_missing);
    turn_rows(t);
    set_spacing(t, image.width / t.nx, image.height / t.ny,
                fmt::format("{:.4g} nm a count", image.step * 1e9), source.path());
    t.note("last row on top");
    return t;
}

std::vector<HeightsChannel> open(const HeightsSource& source) {
    std::vector<HeightsChannel> channels;
    for (const Image& image : File(source).images())
        channels.push_back({image.name, image.nx, image.ny, image.other,
                            [source, image] { return read(source, image); }});
    return channels;
}

}  // namespace

HeightsFormat nanoscope_format() {
    return {"nanoscope", {"spm", "di"}, "Bruker, Veeco and DI Nanoscope: channels of heights",
            recognises,  open,          nullptr};
}

}  // namespace asperity::io
