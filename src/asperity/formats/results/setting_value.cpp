// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/setting_value.h>

#include <cmath>

namespace asperity::io {
namespace {

constexpr std::string_view kAuto = "auto", kNone = "none";

}  // namespace

double SettingValue::number(std::string_view text, const Range& range) const {
    const auto value = parse_double(text);
    if (!value) refuse(in_quotes(text) + " is not a number");
    if (*value < range.low || *value > range.high) refuse(in_quotes(text) + " " + range.rule);
    return *value;
}

std::pair<double, double> SettingValue::pair(const Range& range) const {
    const auto parts = split(text_, ',');
    if (parts.size() > 2) refuse(in_quotes(text_) + " is more than two numbers");
    return {number(parts.front(), range), number(parts.back(), range)};
}

std::pair<std::optional<double>, std::optional<double>> SettingValue::optional_pair(
    const Range& range) const {
    const auto parts = split(text_, ',');
    if (parts.size() > 2) refuse(in_quotes(text_) + " is more than two numbers");
    const auto read = [&](std::string_view part) {
        return part == kAuto ? std::nullopt : std::optional(number(part, range));
    };
    return {read(parts.front()), read(parts.back())};
}

std::vector<double> SettingValue::list(const Range& range) const {
    std::vector<double> numbers;
    if (text_.empty() || text_ == kNone) return numbers;
    for (const std::string_view part : split(text_, ',')) numbers.push_back(number(part, range));
    return numbers;
}

int SettingValue::integer(int low, int high) const {
    const auto value = parse_integer<long long>(text_);
    if (!value) refuse(in_quotes(text_) + " is not a whole number");
    if (*value < low || *value > high)
        refuse(fmt::format("{} must be in {} .. {}", in_quotes(text_), low, high));
    return static_cast<int>(*value);
}

std::uint64_t SettingValue::seed() const {
    const auto value = parse_integer<std::uint64_t>(text_);
    if (!value) refuse(in_quotes(text_) + " is not a whole number in 0 .. 2^64 - 1");
    return *value;
}

std::uint64_t SettingValue::count_or_auto(std::uint64_t low, std::uint64_t high) const {
    if (text_ == kAuto) return 0;
    auto value = parse_integer<std::uint64_t>(text_);
    if (!value) {
        const auto real = parse_double(text_);
        if (real && *real >= 0 && *real <= 0x1p53 && *real == std::floor(*real))
            value = static_cast<std::uint64_t>(*real);
    }
    if (!value || *value < low)
        refuse(fmt::format("{} is not a whole number of at least {}", in_quotes(text_), low));
    if (*value > high) refuse(fmt::format("{} is more than {}", in_quotes(text_), high));
    return *value;
}

double SettingValue::share(std::string_view text, const Range& range) const {
    text = trimmed(text);
    if (!text.ends_with('%')) return number(text, range);
    const auto percent = parse_double(trimmed(text.substr(0, text.size() - 1)));
    if (!percent) refuse(in_quotes(text) + " is not a percentage");
    const double value = *percent / 100;
    if (value < range.low || value > range.high) refuse(in_quotes(text) + " " + range.rule);
    return value;
}

std::vector<double> SettingValue::shares(const Range& range, std::size_t most) const {
    const auto parts = split(text_, ',');
    if (parts.size() > most)
        refuse(fmt::format("{} is more than {} numbers", in_quotes(text_), most));
    std::vector<double> shares;
    for (const std::string_view part : parts) shares.push_back(share(part, range));
    return shares;
}

bool SettingValue::flag() const {
    for (const char* word : {"true", "yes", "on", "1"})
        if (text_ == word) return true;
    for (const char* word : {"false", "no", "off", "0"})
        if (text_ == word) return false;
    refuse(in_quotes(text_) + " is neither true nor false");
}

std::string text_of(std::pair<double, double> pair) {
    const std::string first = shortest(pair.first), second = shortest(pair.second);
    return first == second ? first : first + "," + second;
}

std::string text_of(std::optional<double> x, std::optional<double> y) {
    const auto text = [](std::optional<double> value) {
        return value ? shortest(*value) : std::string(kAuto);
    };
    return text(x) == text(y) ? text(x) : text(x) + "," + text(y);
}

std::string text_of(const std::vector<double>& list) {
    if (list.empty()) return std::string(kNone);
    std::string text;
    for (const double value : list) text += (text.empty() ? "" : ",") + shortest(value);
    return text;
}

}  // namespace asperity::io
