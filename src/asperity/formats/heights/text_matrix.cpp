// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/heights/height_files.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io {
namespace {

constexpr std::uint64_t kMaxTextBytes = std::uint64_t{16} << 30;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::string_view kBlank = " \t\r\v\f";
constexpr std::string_view kAnnouncement = "AsciiMatrix";
constexpr std::size_t kWriteBytes = 1 << 20;

class MatrixReader {
  public:
    MatrixReader(std::string_view text, const std::string& path) : text_(text), path_(path) {
        if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    }

    Heightfield read() {
        while (!text_.empty()) {
            const std::size_t end = std::min(text_.find('\n'), text_.size());
            read_line(text_.substr(0, end));
            text_.remove_prefix(std::min(end + 1, text_.size()));
            ++line_;
        }
        if (numbers_.empty()) throw Error(ErrorCode::InvalidInput, "no numbers", path_);
        if (announced_ && announced_ != std::pair(columns_, rows_))
            throw Error(ErrorCode::InvalidInput,
                        fmt::format("{} x {} numbers are announced, {} x {} found",
                                    announced_->first, announced_->second, columns_, rows_),
                        path_);
        check_sides(columns_, rows_, path_);
        Heightfield surface;
        surface.nx = static_cast<int>(columns_);
        surface.ny = static_cast<int>(rows_);
        surface.heights = std::move(numbers_);
        surface.boundary = Boundary::Finite;
        surface.name = path_;
        return surface;
    }

  private:
    void read_line(std::string_view line) {
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty()) return;
        if (rows_ == 0 && !announced_ && line.starts_with(kAnnouncement)) {
            read_announcement(line.substr(kAnnouncement.size()));
            return;
        }
        const std::size_t before = numbers_.size();
        read_numbers(line);
        const std::uint64_t count = numbers_.size() - before;
        if (rows_ == 0) columns_ = count;
        if (count != columns_)
            fail(fmt::format("{} numbers, the rows above have {}", count, columns_));
        if (++rows_ > static_cast<std::uint64_t>(kMaxSurfaceSide))
            fail(fmt::format("more than {} rows", kMaxSurfaceSide));
    }

    // "W H"
    void read_announcement(std::string_view rest) {
        rest = trimmed(rest);
        const std::size_t gap = std::min(rest.find_first_of(kBlank), rest.size());
        const auto width = parse_integer<std::uint64_t>(rest.substr(0, gap));
        const auto height = parse_integer<std::uint64_t>(trimmed(rest.substr(gap)));
        if (!width || !height) fail("AsciiMatrix needs a width and a height");
        announced_ = std::pair(*width, *height);
    }

    void read_numbers(std::string_view line) {
        // "1,5;2,5" may mean two numbers or four.
        const bool semicolons = line.find(';') != std::string_view::npos;
        if (semicolons && line.find(',') != std::string_view::npos)
            fail("commas and semicolons are mixed: write decimals with a point");
        const char separator = semicolons ? ';' : ',';
        while (!line.empty()) {
            if (line.front() == separator) fail("a number is missing between two separators");
            const std::size_t end =
                std::min(line.find_first_of(std::string(kBlank) + separator), line.size());
            add_number(line.substr(0, end));
            line = skip_blank(line.substr(end));
            // One separator may also end the line.
            if (line.starts_with(separator)) line = skip_blank(line.substr(1));
        }
    }

    static std::string_view skip_blank(std::string_view line) {
        return line.substr(std::min(line.find_first_not_of(kBlank), line.size()));
    }

    void add_number(std::string_view text) {
        const auto number = parse_double(text);
        if (!number) fail(in_quotes(text) + " is not a number");
        if (std::abs(*number) > static_cast<double>(std::numeric_limits<float>::max()))
            fail(in_quotes(text) + " is too large");
        numbers_.push_back(static_cast<float>(*number));
        if (numbers_.size() > static_cast<std::size_t>(kMaxSurfaceSide) * kMaxSurfaceSide)
            fail("too many numbers");
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", path_, line_));
    }

    std::string_view text_;
    const std::string& path_;
    int line_ = 1;
    std::vector<float> numbers_;
    std::uint64_t columns_ = 0, rows_ = 0;
    std::optional<std::pair<std::uint64_t, std::uint64_t>> announced_;
};

}  // namespace

Heightfield read_text_matrix(const std::string& path) {
    const std::string text = read_text_file(path, kMaxTextBytes);
    return MatrixReader(text, path).read();
}

void write_text_matrix(const Heightfield& surface, const std::string& path) {
    AtomicFile file(path);
    std::string text =
        fmt::format("# heights: {} columns (x), {} rows (y)\n", surface.nx, surface.ny);
    const auto columns = static_cast<std::size_t>(surface.nx);
    for (std::size_t k = 0; k < surface.heights.size(); ++k) {
        text += shortest(surface.heights[k]);
        text += (k + 1) % columns == 0 ? '\n' : ' ';
        if (text.size() < kWriteBytes) continue;
        file.write(text);
        text.clear();
    }
    file.write(text);
    file.commit();
}

}  // namespace asperity::io
