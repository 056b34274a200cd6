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
        if (text_[place_] == '\n') ++line_;
    }
    const std::size_t begin = place_;
    while (place_ < text_.size() && !is_space(text_[place_])) ++place_;
    return text_.substr(begin, place_ - begin);
}

std::string_view Words::rest_of_line() {
    const std::size_t begin = place_;
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    place_ = std::min(end + 1, text_.size());
    if (place_ > end) ++line_;
    return text_.substr(begin, end - begin);
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
