// SPDX-License-Identifier: Apache-2.0
// Words and numbers of model files that are text.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace asperity::io::detail {

/// The words of a text, told apart by white space, and the line on which each stands.
class Words {
  public:
    /// `end_of_line`: as end_of_line() finds it.
    explicit Words(std::string_view text, std::uint64_t first_line = 1, char end_of_line = '\n')
        : text_(text), line_(first_line), end_of_line_(end_of_line) {}

    /// The next word; empty at the end.
    std::string_view next();
    /// The rest of the line, the end of line skipped.
    std::string_view rest_of_line();

    /// Of the last word.
    std::uint64_t line() const { return line_; }
    std::size_t left() const { return text_.size() - place_; }

  private:
    std::string_view text_;
    std::size_t place_ = 0;
    std::uint64_t line_;
    char end_of_line_;
};

/// What ends the lines of a text: \n, which may follow \r, or, as on the first Macintoshes, \r.
char end_of_line(std::string_view text);

/// Whether bytes from the start of a file are those of a text.
bool is_text(std::string_view start);

/// Whether the two are alike but for capitals of ASCII.
bool same_word(std::string_view a, std::string_view b);

/// A coordinate. Unlike parse_double this takes nan, inf and a leading +, which exporters write;
/// what is too large to be a number is infinite.
std::optional<double> parse_coordinate(std::string_view word);

}  // namespace asperity::io::detail
