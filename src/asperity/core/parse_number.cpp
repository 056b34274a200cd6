// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/parse_number.h>

#include <asperity/core/printable.h>

#include <array>
#include <cmath>

namespace asperity {
namespace {

constexpr std::size_t kQuotedLength = 60;

template <typename Real>
std::string shortest_of(Real value) {
    std::array<char, 64> buffer;
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end};
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n\v\f";
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::string in_quotes(std::string_view text) {
    return "'" + printable(text.substr(0, kQuotedLength)) +
           (text.size() > kQuotedLength ? "...'" : "'");
}

std::optional<double> parse_double(std::string_view text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string shortest(double value) {
    return shortest_of(value);
}

std::string shortest(float value) {
    return shortest_of(value);
}

}  // namespace asperity
