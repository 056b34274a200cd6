// SPDX-License-Identifier: Apache-2.0
// The text of one option read as a number, a share, a name. Settings of an experiment have their
// own rows; these are the options of a single verb.
#pragma once

#include <asperity/core/parse_number.h>
#include <asperity/params/fields.h>

#include <string>
#include <string_view>

namespace asperity::cli {

/// Every function throws Error(Usage, name) for a text that does not parse or fit.
class OptionValue {
  public:
    OptionValue(const std::string& name, std::string_view text)
        : info_{.name = name}, text_(trimmed(text)) {}

    std::string_view text() const { return text_; }
    double number(const Range& range) const { return read<double>(ParamType::Real, range); }
    int integer(int low, int high) const {
        const Range range = {static_cast<double>(low), static_cast<double>(high)};
        return static_cast<int>(read<std::int64_t>(ParamType::Integer, range));
    }
    std::uint64_t natural(const Range& range = {}) const {
        return read<std::uint64_t>(ParamType::Natural, range);
    }
    /// "1%" or 0.01.
    double share(const Range& range) const { return read<double>(ParamType::Real, range, true); }

    template <typename Value, std::size_t N>
    Value choice(const Names<Value, N>& names) const {
        ParamInfo info = info_;
        info.type = ParamType::Choice;
        for (const auto& [name, value] : names) info.choices.emplace_back(name);
        parse(info, text_);
        for (const auto& [name, value] : names)
            if (text_ == name) return value;
        refuse("is no name");
    }
    /// Numbers between separators.
    std::vector<double> numbers(std::string_view text, char separator, const Range& range) const {
        std::vector<double> list;
        for (const std::string_view part : split(text, separator))
            list.push_back(OptionValue(info_.name, part).number(range));
        return list;
    }
    [[noreturn]] void refuse(std::string why) const { asperity::refuse(info_, std::move(why)); }

  private:
    template <typename T>
    T read(ParamType type, const Range& range, bool percent = false) const {
        ParamInfo info = info_;
        info.type = type;
        info.range = range;
        info.percent = percent;
        const ParamValue value = parse(info, text_);
        check(info, value);
        return std::get<T>(value);
    }

    ParamInfo info_;
    std::string_view text_;
};

}  // namespace asperity::cli
