// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/param.h>

#include <asperity/core/parse_number.h>
#include <asperity/params/suggest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// A unit as people write it, and as rows name it.
struct WrittenUnit {
    std::string_view written, name;
};
constexpr std::array<WrittenUnit, 12> kUnits = {{{"degrees", "degrees"},
                                                 {"degree", "degrees"},
                                                 {"deg", "degrees"},
                                                 {"\u00b0", "degrees"},
                                                 {"rad", "radians"},
                                                 {"nm", "nm"},
                                                 {"\u00b5m", "um"},
                                                 {"um", "um"},
                                                 {"mm", "mm"},
                                                 {"px", "pixels"},
                                                 {"cells", "cells"},
                                                 {"%", "%"}}};

/// What somebody who wrote the number with a unit should write: the number alone only where its
/// unit is that of the row.
std::string unit_cure(const ParamInfo& info, double value, std::string_view unit) {
    if (unit == "%")
        return info.range.contains(value / 100) ? "; did you mean " + shortest(value / 100) + "?"
                                                : std::string();
    if (unit == "um" && info.unit == "nm") value *= 1000;
    const bool own = info.unit == unit || (unit == "um" && info.unit == "nm");
    const std::string taken = info.unit.empty() ? "without a unit" : "in " + info.unit;
    if (own || (unit == "pixels" && info.unit.empty()))
        return fmt::format("; write {}, it is taken {}", shortest(value), taken);
    return "; it is taken " + taken;
}

/// The same, also for a decimal comma.
std::string number_cure(const ParamInfo& info, std::string_view text) {
    for (const WrittenUnit& unit : kUnits) {
        if (!text.ends_with(unit.written)) continue;
        const auto value = parse_double(trimmed(text.substr(0, text.size() - unit.written.size())));
        if (value) return unit_cure(info, *value, unit.name);
    }
    std::string pointed(text);
    const std::size_t comma = pointed.find(',');
    if (comma == std::string::npos) return {};
    pointed[comma] = '.';
    return parse_double(pointed) ? "; did you mean " + pointed + "?" : std::string();
}

double parse_real(const ParamInfo& info, std::string_view text) {
    const bool percent = info.percent && text.ends_with('%');
    const auto value = parse_double(percent ? trimmed(text.substr(0, text.size() - 1)) : text);
    if (!value)
        refuse(info, in_quotes(text) + (percent ? " is not a percentage" : " is not a number") +
                         number_cure(info, text));
    return percent ? *value / 100 : *value;
}

/// For 100k, 10M and 64x64.
std::string whole_cure(const ParamInfo& info, std::string_view text) {
    constexpr std::array<std::pair<std::string_view, const char*>, 4> kSuffixes = {
        {{"k", "e3"}, {"K", "e3"}, {"M", "e6"}, {"G", "e9"}}};
    for (const auto& [suffix, power] : kSuffixes)
        if (text.ends_with(suffix) && parse_double(text.substr(0, text.size() - 1)))
            return fmt::format("; did you mean {}{}?", text.substr(0, text.size() - 1), power);
    const std::size_t x = text.find('x');
    if (x == text.npos || text.substr(0, x) != text.substr(x + 1)) return number_cure(info, text);
    return parse_double(text.substr(0, x)) ? fmt::format("; did you mean {}?", text.substr(0, x))
                                           : std::string();
}

/// Digits, or a number such as 1e6 that is whole and exact.
template <typename Whole>
Whole parse_whole(const ParamInfo& info, std::string_view text) {
    if (const auto value = parse_integer<Whole>(text)) return *value;
    const auto real = parse_double(text);
    const double least = std::is_signed_v<Whole> ? -0x1p53 : 0;
    const std::string cure = real ? std::string() : whole_cure(info, text);
    if (!real || *real != std::floor(*real) || *real < least || *real > 0x1p53)
        refuse(info, in_quotes(text) + " is not a whole number" +
                         (std::is_signed_v<Whole> ? "" : " in 0 .. 2^64 - 1") + cure);
    return static_cast<Whole>(*real);
}

bool parse_flag(const ParamInfo& info, std::string_view text) {
    for (const char* word : {"true", "yes", "on", "1"})
        if (text == word) return true;
    for (const char* word : {"false", "no", "off", "0"})
        if (text == word) return false;
    refuse(info, in_quotes(text) + " is neither true nor false");
}

/// The numbers of "start:stop:step", the stop among them where the steps meet it.
void add_range(const ParamInfo& info, std::string_view text, std::vector<double>& numbers) {
    constexpr double kMost = 10000, kMeets = 1e-9;
    const auto parts = split(text, ':');
    if (parts.size() != 3)
        refuse(info, in_quotes(text) + " is not start:stop:step, such as 0:80:10");
    const double start = parse_real(info, parts[0]), stop = parse_real(info, parts[1]),
                 step = parse_real(info, parts[2]);
    const double steps = (stop - start) / step;
    if (!(steps >= 0))
        refuse(info,
               in_quotes(text) + fmt::format(" never comes from {} to {}", parts[0], parts[1]));
    if (steps > kMost)
        refuse(info, fmt::format("{} is more than {} numbers", in_quotes(text), kMost));
    const int count = static_cast<int>(std::floor(steps + kMeets)) + 1;
    for (int k = 0; k < count; ++k) {
        // As one would write it: 0.3, not what three times 0.1 is.
        constexpr int kDigits = 12;
        const std::string written = fmt::format("{:.{}g}", start + k * step, kDigits);
        numbers.push_back(parse_double(written).value_or(start + k * step));
    }
}

std::vector<double> parse_list(const ParamInfo& info, std::string_view text) {
    std::vector<double> numbers;
    if (info.type == ParamType::List && (text.empty() || text == info.absent)) return numbers;
    const auto parts = split(text, ',');
    const std::size_t most = info.type == ParamType::Pair ? 2 : info.most;
    if (parts.size() > most)
        refuse(info, fmt::format("{} is more than {} numbers", in_quotes(text), most));
    for (const std::string_view part : parts) {
        if (info.type == ParamType::List && part.find(':') != part.npos) {
            add_range(info, part, numbers);
            continue;
        }
        const bool open = info.type == ParamType::Pair && part == info.absent && !part.empty();
        numbers.push_back(open ? std::nan("") : parse_real(info, part));
    }
    if (info.type == ParamType::Pair) numbers.resize(2, numbers.front());
    if (numbers.size() > most)
        refuse(info, fmt::format("{} is more than {} numbers", in_quotes(text), most));
    return numbers;
}

void check_number(const ParamInfo& info, double value, const std::string& text) {
    if (info.range.contains(value)) return;
    // Who writes a wavelength in micrometres means one a thousand times as large in nm.
    if (info.unit == "nm" && info.range.contains(1000 * value))
        refuse(info, in_quotes(text) + " " + info.range.rule() + " nm; did you mean " +
                         shortest(1000 * value) + "?");
    // Who writes a share as 2 means two in a hundred.
    const bool hundredths = info.percent && value >= 1 && value < 100;
    refuse(info, in_quotes(text) + " " + info.range.rule() +
                     (info.unit.empty() ? "" : " " + info.unit) +
                     (hundredths ? "; did you mean " + text + "%?" : ""));
}

std::string real_text(double value, const ParamInfo& info) {
    return std::isnan(value) ? info.absent : shortest(value);
}

std::string list_text(const ParamInfo& info, const std::vector<double>& list) {
    if (list.empty()) return info.absent;
    std::string text = real_text(list.front(), info);
    const bool one = info.type == ParamType::Pair && real_text(list.back(), info) == text;
    for (std::size_t k = 1; k < list.size() && !one; ++k) text += "," + real_text(list[k], info);
    return text;
}

}  // namespace

namespace {

/// The end of a range, as one would write it: 0.0001, 32768, 1e+15.
std::string end_text(double x) {
    return std::abs(x) < 1e5 ? fmt::format("{}", x) : shortest(x);
}

}  // namespace

std::string Range::rule() const {
    const bool below = high != kNoEnd, above = low != -kNoEnd;
    if (!below && !above) return "must be finite";
    if (below && above && !low_open && !high_open)
        return fmt::format("must be in {} .. {}", end_text(low), end_text(high));
    if (!below && low == 0 && !low_open) return "must not be negative";
    std::string rule = "must be ";
    if (above) rule += fmt::format("{} {}", low_open ? "above" : "at least", end_text(low));
    if (below && above) rule += " and ";
    if (below) rule += fmt::format("{} {}", high_open ? "below" : "at most", end_text(high));
    return rule;
}

std::string Range::text() const {
    const bool below = high != kNoEnd, above = low != -kNoEnd;
    if (below && above && !low_open && !high_open)
        return fmt::format("{} .. {}", end_text(low), end_text(high));
    std::string text;
    if (above) text += fmt::format("{} {}", low_open ? "above" : "at least", end_text(low));
    if (below && above) text += ", ";
    if (below) text += fmt::format("{} {}", high_open ? "below" : "at most", end_text(high));
    return text;
}

void refuse(const ParamInfo& info, std::string why) {
    throw Error(ErrorCode::Usage, std::move(why), info.name);
}

ParamValue parse(const ParamInfo& info, std::string_view raw) {
    const std::string_view text = trimmed(raw);
    const bool list = info.type == ParamType::List || info.type == ParamType::Pair;
    if (!list && !info.absent.empty() && text == info.absent) return std::monostate{};
    switch (info.type) {
        case ParamType::Flag:
            return parse_flag(info, text);
        case ParamType::Integer:
            return parse_whole<std::int64_t>(info, text);
        case ParamType::Natural:
            return parse_whole<std::uint64_t>(info, text);
        case ParamType::Real:
            return parse_real(info, text);
        case ParamType::List:
        case ParamType::Pair:
            return parse_list(info, text);
        case ParamType::Choice:
            if (std::find(info.choices.begin(), info.choices.end(), text) == info.choices.end())
                refuse(info, fmt::format("{} is none of {}{}", in_quotes(text),
                                         fmt::join(info.choices, ", "),
                                         did_you_mean(std::string(text), info.choices)));
            return std::string(text);
        case ParamType::Text:
            break;
    }
    return std::string(raw);
}

void check(const ParamInfo& info, const ParamValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        check_number(info, static_cast<double>(*integer), std::to_string(*integer));
    else if (const auto* natural = std::get_if<std::uint64_t>(&value))
        check_number(info, static_cast<double>(*natural), std::to_string(*natural));
    else if (const auto* real = std::get_if<double>(&value))
        check_number(info, *real, shortest(*real));
    else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
        // Who writes 0,3 as in a language with a decimal comma
        const bool comma = info.type == ParamType::Pair && list->size() == 2 && (*list)[0] == 0 &&
                           !info.range.contains(0) && info.range.contains((*list)[1] / 10);
        if (comma)
            refuse(info, fmt::format("'0' {}; did you mean 0.{}?", info.range.rule(),
                                     shortest((*list)[1])));
        for (const double entry : *list)
            if (!(std::isnan(entry) && info.type == ParamType::Pair && !info.absent.empty()))
                check_number(info, entry, shortest(entry));
    }
}

std::string format(const ParamInfo& info, const ParamValue& value) {
    struct Writer {
        const ParamInfo& info;
        std::string operator()(std::monostate) const { return info.absent; }
        std::string operator()(bool flag) const { return flag ? "true" : "false"; }
        std::string operator()(std::int64_t number) const { return std::to_string(number); }
        std::string operator()(std::uint64_t number) const { return std::to_string(number); }
        std::string operator()(double number) const { return shortest(number); }
        std::string operator()(const std::string& text) const { return text; }
        std::string operator()(const std::vector<double>& list) const {
            return list_text(info, list);
        }
    };
    return std::visit(Writer{info}, value);
}

std::string metavar(const ParamInfo& info) {
    if (!info.metavar.empty()) return info.metavar;
    switch (info.type) {
        case ParamType::Flag:
            return {};
        case ParamType::Integer:
        case ParamType::Natural:
            return "N";
        case ParamType::Real:
            return "X";
        case ParamType::Choice:
            return "NAME";
        case ParamType::Text:
            return "TEXT";
        case ParamType::List:
            return "X[,X...]";
        case ParamType::Pair:
            return "X[,Y]";
    }
    return {};
}

std::string help_text(const ParamInfo& info) {
    std::string text = info.users.empty() ? info.doc : info.users + ": " + info.doc;
    const std::string range = info.range.text();
    if (!range.empty())
        text += "; " + range + (info.unit.empty() ? "" : " " + info.unit);
    else if (!info.unit.empty())
        text += ", in " + info.unit;
    return text;
}

std::string label(const ParamInfo& info) {
    if (!info.label.empty()) return info.label;
    std::string text = info.name;
    bool begins = true;
    for (char& c : text) {
        if (begins) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        begins = c == '-';
        if (begins) c = ' ';
    }
    return text;
}

}  // namespace asperity
