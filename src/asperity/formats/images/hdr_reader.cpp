// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/images/image_formats.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/images/primaries.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace asperity::io::detail {
namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{2} << 30;
constexpr std::size_t kMaxHeaderLine = 4096;
constexpr double kLeastExposure = 1e-100;  // and its inverse the most: numbers stay finite

// A picture of more bytes than this must not be this many times as large as its file.
// The new run lengths reach 190 times at most.
constexpr std::uint64_t kTrustedBytes = 1 << 24;
constexpr std::uint64_t kMaxCompression = 1000;

// Scan lines of these lengths may have the new run lengths.
constexpr std::size_t kLeastRunLine = 8, kMostRunLine = 0x7fff;

/// One of the two parts of "-Y 512 +X 1024".
struct Axis {
    char name = ' ';  // X or Y
    bool forward = true;
    std::uint64_t length = 0;
};

/// The pixels of a scan line as they stand in the file: three mantissas and their exponent.
using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
  public:
    HdrReader(std::string path, std::string_view bytes) : path_(std::move(path)), bytes_(bytes) {}

    Image read() {
        read_header();
        read_resolution();
        prepare_scale();
        std::vector<Rgbe> line(static_cast<std::size_t>(places_.length));
        check_lines(line);
        Image image{static_cast<int>(columns().length), static_cast<int>(rows().length), {}};
        image.rgb.resize(static_cast<std::size_t>(3 * lines_.length * places_.length));
        for (std::size_t k = 0; k < lines_.length; ++k) {
            read_line(line);
            store(line, k, image);
        }
        convert_to_rec709(image, primaries_, path_);
        return image;
    }

  private:
    void read_header();
    void read_resolution();
    Axis axis(std::string_view direction, std::string_view length) const;
    void prepare_scale();
    void check_lines(std::vector<Rgbe>& line);
    void read_line(std::vector<Rgbe>& line);
    void read_new_runs(std::vector<Rgbe>& line);
    void read_old_runs(std::vector<Rgbe>& line);
    void store(const std::vector<Rgbe>& line, std::size_t number, Image& image) const;

    const Axis& columns() const { return lines_.name == 'X' ? lines_ : places_; }
    const Axis& rows() const { return lines_.name == 'Y' ? lines_ : places_; }

    std::string_view text_line() {
        const std::size_t end = bytes_.find('\n', place_);
        if (end == std::string_view::npos) fail("the file ends inside the header");
        if (end - place_ > kMaxHeaderLine) fail("a line of the header is too long");
        const std::string_view line = bytes_.substr(place_, end - place_);
        place_ = end + 1;
        return line;
    }
    /// Between blanks; empty when they are not `count` numbers.
    static std::vector<double> numbers(std::string_view text, std::size_t count) {
        std::vector<double> found;
        for (const std::string_view word : split(text, ' ')) {
            if (word.empty()) continue;
            const std::optional<double> number = parse_double(word);
            if (!number) return {};
            found.push_back(*number);
        }
        return found.size() == count ? found : std::vector<double>{};
    }
    std::uint8_t byte() {
        if (place_ >= bytes_.size()) fail("the file ends inside the pixels");
        return static_cast<std::uint8_t>(bytes_[place_++]);
    }
    Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }  // in this order, by the braces

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", path_, place_));
    }

    std::string path_;
    std::string_view bytes_;
    std::size_t place_ = 0;
    double exposure_ = 1;
    std::array<double, 3> correction_{1, 1, 1};  // of red, green and blue
    Primaries primaries_;
    Axis lines_, places_;  // from line to line, and along a line
    std::array<double, 256> scale_{};
};

void HdrReader::read_header() {
    text_line();  // "#?RADIANCE" or another program's name
    for (std::string_view line = trimmed(text_line()); !line.empty(); line = trimmed(text_line())) {
        const std::size_t equals = line.find('=');
        if (line.front() == '#' || equals == std::string_view::npos) continue;
        const std::string_view key = trimmed(line.substr(0, equals));
        const std::string_view value = trimmed(line.substr(equals + 1));
        if (key == "FORMAT" && value != "32-bit_rle_rgbe")
            fail(fmt::format("the format {} is not read, 32-bit_rle_rgbe is", in_quotes(value)));
        if (key == "EXPOSURE") {
            // Each program that changed the brightness has left a line: all of them count.
            const std::optional<double> factor = parse_double(value);
            exposure_ *= factor.value_or(0);
            if (!(exposure_ > kLeastExposure && exposure_ < 1 / kLeastExposure))
                fail(fmt::format("the exposure {} cannot be undone", in_quotes(value)));
        }
        if (key == "COLORCORR") {
            const std::vector<double> factors = numbers(value, 3);
            for (std::size_t c = 0; c < 3; ++c) {
                correction_[c] *= factors.empty() ? 0 : factors[c];
                if (!(correction_[c] > kLeastExposure && correction_[c] < 1 / kLeastExposure))
                    fail(fmt::format("the correction {} cannot be undone", in_quotes(value)));
            }
        }
        if (key == "PRIMARIES") {
            const std::vector<double> p = numbers(value, 8);
            if (p.empty()) fail(fmt::format("{} are not 8 chromaticities", in_quotes(value)));
            primaries_ = {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}};
        }
    }
}

Axis HdrReader::axis(std::string_view direction, std::string_view length) const {
    if (direction != "-Y" && direction != "+Y" && direction != "-X" && direction != "+X")
        fail("the resolution is not of the form -Y height +X width");
    const auto count = parse_integer<std::uint64_t>(length);
    if (!count || *count > kMaxImageSide)
        fail(fmt::format("a side of {} pixels, 1 to {} are allowed", in_quotes(length),
                         kMaxImageSide));
    return {direction[1], direction[0] == '+', *count};
}

void HdrReader::read_resolution() {
    std::vector<std::string_view> words;
    for (const std::string_view word : split(trimmed(text_line()), ' '))
        if (!word.empty()) words.push_back(word);
    if (words.size() != 4) fail("the resolution is not of the form -Y height +X width");
    lines_ = axis(words[0], words[1]);
    places_ = axis(words[2], words[3]);
    if (lines_.name == places_.name) fail("the resolution names an axis twice");
    check_image_size(columns().length, rows().length, path_);

    // A line takes 4 bytes at least
    if (4 * lines_.length > bytes_.size() - place_)
        fail(fmt::format("{} x {} pixels do not fit a file of {} bytes", columns().length,
                         rows().length, bytes_.size()));
}

/// Walks over all lines before memory is taken for the picture, and back: what stands behind the
/// last of them does not count.
void HdrReader::check_lines(std::vector<Rgbe>& line) {
    const std::size_t start = place_;
    for (std::size_t k = 0; k < lines_.length; ++k) read_line(line);
    const std::uint64_t bytes = 3 * sizeof(float) * lines_.length * places_.length;
    if (bytes > kTrustedBytes && bytes / kMaxCompression > place_ - start)
        fail(fmt::format("{} x {} pixels out of {} bytes", columns().length, rows().length,
                         place_ - start));
    place_ = start;
}

/// Mantissas count in 2^-8 of 2^(exponent - 128).
void HdrReader::prepare_scale() {
    for (int exponent = 1; exponent < 256; ++exponent)
        scale_[static_cast<std::size_t>(exponent)] = std::ldexp(1.0, exponent - 136) / exposure_;
}

void HdrReader::read_line(std::vector<Rgbe>& line) {
    // New run lengths begin with 2, 2 and the length of the line
    if (line.size() >= kLeastRunLine && line.size() <= kMostRunLine &&
        bytes_.size() - place_ >= 4 && bytes_[place_] == 2 && bytes_[place_ + 1] == 2 &&
        static_cast<std::uint8_t>(bytes_[place_ + 2]) < 0x80)
        read_new_runs(line);
    else
        read_old_runs(line);
}

/// Each component of the line for itself: a count above 128 and the byte of a run, or a count and
/// as many bytes.
void HdrReader::read_new_runs(std::vector<Rgbe>& line) {
    const Rgbe start = pixel();
    const std::size_t length = static_cast<std::size_t>(start[2]) << 8 | start[3];
    if (length != line.size())
        fail(fmt::format("a line of {} pixels, all have {}", length, line.size()));
    for (std::size_t component = 0; component < 4; ++component) {
        for (std::size_t k = 0; k < line.size();) {
            const std::uint8_t code = byte();
            const std::size_t count = code > 128 ? code - 128u : code;
            if (count == 0) fail("a run of no pixels");
            if (count > line.size() - k) fail("a run goes beyond its line");
            const std::size_t end = k + count;
            if (code > 128) {
                const std::uint8_t value = byte();
                for (; k < end; ++k) line[k][component] = value;
            } else {
                for (; k < end; ++k) line[k][component] = byte();
            }
        }
    }
}

/// Whole pixels. One of mantissas 1, 1, 1 repeats the one before as often as its exponent says;
/// several such on end are the digits of a count to the base 256, the lowest first.
void HdrReader::read_old_runs(std::vector<Rgbe>& line) {
    int shift = 0;
    for (std::size_t k = 0; k < line.size();) {
        const Rgbe next = pixel();
        if (next[0] != 1 || next[1] != 1 || next[2] != 1) {
            line[k++] = next;
            shift = 0;
            continue;
        }
        if (k == 0) fail("a line begins with a repetition");
        if (shift > 24) fail("a repetition has too many digits");
        const std::size_t count = static_cast<std::size_t>(next[3]) << shift;
        if (count > line.size() - k) fail("a run goes beyond its line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(k), count, line[k - 1]);
        k += count;
        shift += 8;
    }
}

void HdrReader::store(const std::vector<Rgbe>& line, std::size_t number, Image& image) const {
    constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
    const auto width = static_cast<std::size_t>(image.width);
    // -Y and +X are the ways of a picture that is read as text: row 0 on top, column 0 on the left
    const auto along = [](const Axis& axis, std::size_t k) {
        const bool usual = axis.forward == (axis.name == 'X');
        return usual ? k : static_cast<std::size_t>(axis.length) - 1 - k;
    };
    const std::size_t fixed = along(lines_, number);
    for (std::size_t k = 0; k < line.size(); ++k) {
        const std::size_t moving = along(places_, k);
        const std::size_t x = lines_.name == 'X' ? fixed : moving;
        const std::size_t y = lines_.name == 'X' ? moving : fixed;
        const double scale = scale_[line[k][3]];
        for (std::size_t c = 0; c < 3; ++c)
            image.rgb[3 * (y * width + x) + c] =
                static_cast<float>(std::min(line[k][c] * (scale / correction_[c]), kMost));
    }
}

Image read_hdr(const std::string& path) {
    const std::string bytes = read_text_file(path, kMaxFileBytes);
    return HdrReader(path, bytes).read();
}

bool is_hdr(const FileStart& start) {
    return start.bytes.starts_with("#?");
}

}  // namespace

ImageFormat hdr_format() {
    return {"Radiance HDR", {".hdr", ".pic", ".rgbe"}, is_hdr, read_hdr};
}

}  // namespace asperity::io::detail
