// SPDX-License-Identifier: Apache-2.0
// Strict reading of numbers and words; nothing here depends on the locale.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// `text` without white space at both ends.
std::string_view trimmed(std::string_view text);

/// The parts between the separators, trimmed; at least one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// `text` in single quotes for an error message: one line, cut when long, no control characters.
std::string in_quotes(std::string_view text);

/// The whole text as a decimal number; nothing for anything else, nan and inf included.
std::optional<double> parse_double(std::string_view text);

/// The whole text as an integer of this type; nothing when it does not fit.
template <typename Integer>
std::optional<Integer> parse_integer(std::string_view text) {
    Integer value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

/// The shortest decimal that reads back to the same bits.
std::string shortest(double value);
std::string shortest(float value);

}  // namespace asperity
