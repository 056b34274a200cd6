// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/text_table.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace asperity::io {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::string_view kBlank = " \t\r\v\f";
constexpr std::size_t kSampledLines = 64;
constexpr std::size_t kMaxHeaderLines = 10000;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool starts_like_number(std::string_view word) {
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
    return !word.empty() && (is_digit(word[0]) || word[0] == '.' || word[0] == ',');
}

std::string_view next_line(std::string_view& rest) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return line;
}

bool missing_word(std::string_view word) {
    constexpr std::array<std::string_view, 9> kWords = {"nan", "NaN", "NAN", "BAD",    "Bad",
                                                        "bad", "---", "***", "1.#QNAN"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

class TableReader {
  public:
    TableReader(const HeightsSource& source, bool ragged) : source_(source), ragged_(ragged) {
        text_ = source.text();
        if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
        if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
            source.refuse("the text is UTF-16: save it as UTF-8");
        if (text_.find('\0') != std::string_view::npos)
            source.refuse("holds zero bytes: this is no text, and of no known format");
        choose_decimals();
    }

    TextTable read() {
        source_.run().begin("reading heights", text_.size());
        std::string_view rest = text_;
        while (!rest.empty()) {
            const std::size_t before = rest.size();
            ++line_;
            read_line(next_line(rest));
            source_.run().advance(before - rest.size());
            if (line_ % 64 == 0) source_.throw_if_stopped();
        }
        source_.run().end();
        if (table_.numbers.empty()) source_.refuse("no numbers");
        table_.decimal_comma = comma_decimal_;
        return std::move(table_);
    }

  private:
    // Looks at the first rows of numbers. Commas at the end of a word, or with no other separator,
    // are separators; one within a word that blanks, tabs or semicolons end is a decimal comma.
    void choose_decimals() {
        const std::string& wish = source_.options().decimal;
        if (!wish.empty() && wish != "point" && wish != "comma")
            throw Error(ErrorCode::Usage, in_quotes(wish) + " is neither point nor comma",
                        "decimal");
        comma_decimal_ = wish == "comma";
        if (!wish.empty()) return;
        std::string_view rest = text_;
        std::size_t number = 0, seen = 0;
        while (!rest.empty() && seen < kSampledLines) {
            ++number;
            std::string_view line = next_line(rest);
            line = trimmed(line.substr(0, line.find('#')));
            if (!starts_like_number(line) || line.find(',') == std::string_view::npos) continue;
            ++seen;
            if (look_at(line, number)) return;
        }
    }

    // True when the line decides.
    bool look_at(std::string_view line, std::size_t number) {
        if (line.find_first_of(" \t;") == std::string_view::npos) return false;
        bool inner = false, point = false;
        while (!line.empty()) {
            const std::size_t end = std::min(line.find_first_of(" \t;"), line.size());
            const std::string_view word = line.substr(0, end);
            line.remove_prefix(std::min(end + 1, line.size()));
            const auto commas = std::count(word.begin(), word.end(), ',');
            if (commas == 0) {
                point |= word.find('.') != std::string_view::npos;
                continue;
            }
            if (word.front() == ',' || word.back() == ',') return true;
            if (commas > 1 || word.find('.') != std::string_view::npos) refuse_both(word, number);
            inner = true;
        }
        if (inner && point)
            source_.refuse_line(number,
                                "numbers with decimal points and with commas stand in one row: "
                                "--decimal point takes the commas as separators, --decimal comma "
                                "as decimal commas");
        comma_decimal_ = inner;
        return inner;
    }

    [[noreturn]] void refuse_both(std::string_view word, std::size_t number) const {
        source_.refuse_line(
            number, fmt::format("{} can be read two ways: --decimal point takes its commas as "
                                "separators between numbers, --decimal comma as decimal commas",
                                in_quotes(word)));
    }

    void read_line(std::string_view line) {
        const std::size_t hash = line.find('#');
        if (hash != std::string_view::npos) {
            keep_header(line.substr(hash + 1), true);
            line = line.substr(0, hash);
        }
        line = trimmed(line);
        if (line.empty()) return;
        if (table_.rows == 0 && !starts_like_number(line) && !missing_word(first_word(line)))
            return keep_header(line, false);
        if (table_.rows == 0) table_.first_line = line_;
        const std::size_t before = table_.numbers.size();
        read_numbers(line);
        const std::uint64_t count = table_.numbers.size() - before;
        if (table_.rows == 0) table_.columns = count;
        if (count != table_.columns && !ragged_)
            fail(fmt::format("{} numbers, the rows above have {}", count, table_.columns));
        ++table_.rows;
    }

    void keep_header(std::string_view text, bool comment) {
        if (table_.header.size() >= kMaxHeaderLines) return;
        text = trimmed(text);
        if (!text.empty())
            table_.header.push_back({line_, std::string(text.substr(0, 500)), comment});
    }

    std::string_view first_word(std::string_view line) const {
        return line.substr(0, line.find_first_of(std::string(kBlank) + ";,"));
    }

    void read_numbers(std::string_view line) {
        const bool semicolons = line.find(';') != std::string_view::npos;
        if (semicolons && !comma_decimal_ && line.find(',') != std::string_view::npos)
            fail(
                "commas and semicolons stand in one row: --decimal comma takes the commas as "
                "decimal commas");
        const char separator = semicolons || comma_decimal_ ? ';' : ',';
        while (!line.empty()) {
            if (line.front() == separator) fail("a number is missing between two separators");
            std::size_t end = 0;
            while (end < line.size() && line[end] != separator &&
                   kBlank.find(line[end]) == std::string_view::npos)
                ++end;
            add_number(line.substr(0, end));
            line = skip_blank(line.substr(end));
            // One separator may also end the line.
            if (line.starts_with(separator)) line = skip_blank(line.substr(1));
        }
    }

    static std::string_view skip_blank(std::string_view line) {
        return line.substr(std::min(line.find_first_not_of(kBlank), line.size()));
    }

    void add_number(std::string_view word) {
        if (comma_decimal_ && word.find('.') != std::string_view::npos)
            fail(in_quotes(word) + " has a decimal point, the rows above have decimal commas");
        const auto number = table_number(word, comma_decimal_);
        if (!number) fail(in_quotes(word) + " is not a number");
        if (std::abs(*number) > static_cast<double>(std::numeric_limits<float>::max()))
            fail(in_quotes(word) + " is too large");
        table_.numbers.push_back(*number);
        if (table_.numbers.size() > static_cast<std::size_t>(kMaxSurfaceSide) * kMaxSurfaceSide)
            fail("too many numbers");
    }

    [[noreturn]] void fail(const std::string& why) const { source_.refuse_line(line_, why); }

    const HeightsSource& source_;
    bool ragged_ = false, comma_decimal_ = false;
    std::string_view text_;
    std::size_t line_ = 0;
    TextTable table_;
};

}  // namespace

std::optional<double> table_number(std::string_view word, bool comma) {
    if (missing_word(word)) return std::numeric_limits<double>::quiet_NaN();
    if (!comma || word.find(',') == std::string_view::npos) return parse_double(word);
    std::array<char, 64> copy{};
    if (word.size() > copy.size() || word.find('.') != std::string_view::npos) return std::nullopt;
    std::replace_copy(word.begin(), word.end(), copy.begin(), ',', '.');
    return parse_double({copy.data(), word.size()});
}

TextTable read_text_table(const HeightsSource& source, bool ragged) {
    return TableReader(source, ragged).read();
}

bool looks_like_text(std::string_view head) {
    return !head.empty() && std::all_of(head.begin(), head.end(), [](char c) {
        const auto u = static_cast<unsigned char>(c);
        return u >= 0x20 || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f';
    });
}

}  // namespace asperity::io
