// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/heights/heights_source.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// A line before the numbers, or a comment.
struct TextLine {
    std::size_t number = 0;  ///< from 1
    std::string text;        ///< without '#'
    bool comment = false;
};

/// Numbers in rows, as a text has them.
struct TextTable {
    std::vector<TextLine> header;
    std::vector<double> numbers;  ///< NaN where missing
    std::uint64_t columns = 0, rows = 0;
    std::size_t first_line = 0;  ///< of the numbers
    bool decimal_comma = false;
};

/// Reads numbers apart by white space, semicolons or commas, with decimal points or commas. '#'
/// starts a comment; lines that begin with a word and stand before the numbers are header lines.
/// NaN, BAD, --- and *** are missing points. Commas are decimal where tabs, blanks or semicolons
/// stand between the numbers; options().decimal decides otherwise. `ragged` allows rows of unequal
/// length (columns is then that of the first). Throws Error(InvalidInput, "path:line"), also for
/// numbers that can be read two ways, naming both.
TextTable read_text_table(const HeightsSource& source, bool ragged = false);

/// A number with a decimal point, or comma where `comma`; NaN for the words of missing points;
/// nothing for anything else.
std::optional<double> table_number(std::string_view word, bool comma);

/// Whether a file that begins like this is text: no control characters but white space.
bool looks_like_text(std::string_view head);

}  // namespace asperity::io
