// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/model_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace asperity::io::detail {
namespace {

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

std::string_view Words::next() {
    for (; place_ < text_.size() && is_space(text_[place_]); ++place_) {
        if (text_[place_] == end_of_line_) ++line_;
    }
    const std::size_t begin = place_;
    while (place_ < text_.size() && !is_space(text_[place_])) ++place_;
    return text_.substr(begin, place_ - begin);
}

std::string_view Words::rest_of_line() {
    const std::size_t begin = place_;
    const std::size_t end = std::min(text_.find(end_of_line_, begin), text_.size());
    place_ = std::min(end + 1, text_.size());
    if (place_ > end) ++line_;
    return text_.substr(begin, end - begin);
}

char end_of_line(std::string_view text) {
    const std::size_t first = text.find_first_of("\r\n");
    const bool old_macintosh = first != std::string_view::npos && text[first] == '\r' &&
                               first + 1 < text.size() && text[first + 1] != '\n';
    return old_macintosh ? '\r' : '\n';
}

bool is_text(std::string_view start) {
    return std::all_of(start.begin(), start.end(),
                       [](char c) { return static_cast<unsigned char>(c) >= ' ' || is_space(c); });
}

bool same_word(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

std::optional<double> parse_coordinate(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || word.empty()) return std::nullopt;
    // Too large or too small for a double; a model has no use for either.
    if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
    if (error != std::errc{}) return std::nullopt;
    return value;
}

}  // namespace asperity::io::detail
