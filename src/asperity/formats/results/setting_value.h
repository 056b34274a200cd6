// SPDX-License-Identifier: Apache-2.0
// The value of one setting: its text read as a number, a list, a name, with errors that say which
// setting and which text.
#pragma once

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io {

/// The numbers a setting accepts, both ends included.
struct Range {
    double low, high;
    const char* rule;  ///< completes "'7' ...", e.g. "must be above 0"
};

inline constexpr double kLargest = std::numeric_limits<double>::max();
inline constexpr Range kAnyNumber = {-kLargest, kLargest, "must be finite"};
inline constexpr Range kAboveZero = {std::numeric_limits<double>::denorm_min(), kLargest,
                                     "must be above 0"};
inline constexpr Range kNotNegative = {0, kLargest, "must not be negative"};
inline constexpr Range kZeroToOne = {0, 1, "must be in 0 .. 1"};

template <typename Enum, std::size_t N>
using Names = std::array<std::pair<const char*, Enum>, N>;

/// Every function throws Error(Usage, key) for a text that does not parse or fit.
class SettingValue {
  public:
    SettingValue(const std::string& key, std::string_view text)
        : key_(key), raw_(text), text_(trimmed(text)) {}

    std::string_view text() const { return text_; }
    /// Not trimmed.
    std::string_view raw() const { return raw_; }

    double number(const Range& range) const { return number(text_, range); }

    /// "0.3" or "0.3,0.1": one number serves both.
    std::pair<double, double> pair(const Range& range) const;
    /// The same, each number or "auto".
    std::pair<std::optional<double>, std::optional<double>> optional_pair(const Range& range) const;
    /// Numbers between commas; "none" and an empty text are the empty list.
    std::vector<double> list(const Range& range) const;

    int integer(int low, int high) const;
    std::uint64_t seed() const;
    /// A whole number, "1e6" included; 0 for "auto".
    std::uint64_t count_or_auto(std::uint64_t low, std::uint64_t high) const;
    /// "1%" or 0.01, up to `most` of them between commas.
    std::vector<double> shares(const Range& range, std::size_t most) const;
    bool flag() const;

    template <typename Enum, std::size_t N>
    Enum choice(const Names<Enum, N>& names) const {
        std::string known;
        for (const auto& [name, value] : names) {
            if (text_ == name) return value;
            known += known.empty() ? name : fmt::format(", {}", name);
        }
        refuse(fmt::format("{} is none of {}", in_quotes(text_), known));
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(ErrorCode::Usage, why, key_);
    }

  private:
    double number(std::string_view text, const Range& range) const;
    double share(std::string_view text, const Range& range) const;

    const std::string& key_;
    std::string_view raw_, text_;
};

/// The other way: values as text that SettingValue reads back to the same bits.
std::string text_of(std::pair<double, double> pair);
std::string text_of(std::optional<double> x, std::optional<double> y);
std::string text_of(const std::vector<double>& list);

template <typename Enum, std::size_t N>
std::string text_of(const Names<Enum, N>& names, Enum value) {
    for (const auto& [name, named] : names)
        if (named == value) return name;
    return {};
}

}  // namespace asperity::io
