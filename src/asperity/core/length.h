// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity {

/// Metres per unit of a word such as "nm", "µm" in UTF-8 or Latin-1, "um", "microns"; 0 for a word
/// that is no unit of length.
double metres_per(std::string_view unit);

/// A length of metres in a unit that suits it: "0.366 um".
std::string length_text(double metres);

/// A length as a user gives it: with a unit, "2.5 um", or in the unit of whatever it is for.
struct Length {
    double value = 0;
    std::string unit;  ///< a word of metres_per(), or empty

    friend bool operator==(const Length&, const Length&) = default;
};

/// "2.5um", "2.5 um", "2.5"; nothing for anything else. The unit is stored in plain letters.
std::optional<Length> parse_length(std::string_view text);
/// The text that parse_length() reads back.
std::string text_of(const Length& length);

/// The length in `unit`, "m" or another word for a unit that is no length ("cell"); nothing when
/// only one of the two is a unit of length.
std::optional<double> in_unit(const Length& length, const std::string& unit);

}  // namespace asperity
