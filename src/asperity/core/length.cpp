// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/length.h>

#include <asperity/core/parse_number.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

struct Unit {
    const char* word;
    double metres;
};

constexpr Unit kUnits[] = {
    {"m", 1},
    {"meter", 1},
    {"metre", 1},
    {"meters", 1},
    {"metres", 1},
    {"dm", 1e-1},
    {"cm", 1e-2},
    {"mm", 1e-3},
    {"millimeter", 1e-3},
    {"millimeters", 1e-3},
    {"um", 1e-6},
    {"\xc2\xb5m", 1e-6},  // micro sign, UTF-8
    {"\xce\xbcm", 1e-6},  // Greek mu, UTF-8
    {"\xb5m", 1e-6},      // Latin-1
    {"\xe6m", 1e-6},      // code page 437, in Digital Surf's files
    {"~m", 1e-6},         // SPIP
    {"micron", 1e-6},
    {"microns", 1e-6},
    {"micrometer", 1e-6},
    {"micrometers", 1e-6},
    {"nm", 1e-9},
    {"nanometer", 1e-9},
    {"nanometers", 1e-9},
    {"pm", 1e-12},
    {"\xc3\x85", 1e-10},      // Angstrom letter, UTF-8
    {"\xe2\x84\xab", 1e-10},  // Angstrom sign, UTF-8
    {"\xc5", 1e-10},          // Latin-1
    {"Angstrom", 1e-10},
    {"km", 1e3},
};

/// The first word for a unit of so many metres.
std::string plain_word(double metres) {
    for (const Unit& unit : kUnits)
        if (unit.metres == metres && static_cast<signed char>(unit.word[0]) > 0) return unit.word;
    return {};
}

}  // namespace

double metres_per(std::string_view unit) {
    for (const Unit& known : kUnits)
        if (unit == known.word) return known.metres;
    return 0;
}

std::string length_text(double metres) {
    constexpr Unit kShown[] = {{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
    for (const Unit& unit : kShown)
        if (std::abs(metres) >= 0.1 * unit.metres)
            return fmt::format("{:.6g} {}", metres / unit.metres, unit.word);
    return fmt::format("{:.6g} m", metres);
}

std::optional<Length> parse_length(std::string_view text) {
    text = trimmed(text);
    if (const auto number = parse_double(text)) return Length{*number, {}};
    // The unit begins where what is left of it is a number
    const std::size_t end = text.find_last_of("0123456789.");
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = parse_double(text.substr(0, end + 1));
    const double metres = metres_per(trimmed(text.substr(end + 1)));
    if (!number || metres == 0) return std::nullopt;
    return Length{*number, plain_word(metres)};
}

std::string text_of(const Length& length) {
    return shortest(length.value) + (length.unit.empty() ? "" : " " + length.unit);
}

std::optional<double> in_unit(const Length& length, const std::string& unit) {
    if (length.unit.empty()) return length.value;
    const double have = metres_per(length.unit), want = metres_per(unit);
    if (have == 0 || want == 0) return std::nullopt;
    return length.value * (have / want);
}

}  // namespace asperity
