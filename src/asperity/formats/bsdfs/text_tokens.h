// SPDX-License-Identifier: Apache-2.0
#pragma once

// Words and numbers of text formats, with the lines they stand in; inside this folder only.

#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// The words of a text between white space; lines that begin with "#" are left out.
class TextTokens {
  public:
    /// Reads the whole file, but for its first `lines_left_out` lines. Throws as read_text_file.
    explicit TextTokens(const std::string& path, int lines_left_out = 0);

    bool at_end() const { return next_ == words_.size(); }
    /// The next word; empty at the end.
    std::string_view peek() const;
    /// Throws Error(InvalidInput, path) at the end.
    std::string_view word();
    /// Takes the next word if it is this one.
    bool take(std::string_view word);
    /// Throws Error(InvalidInput, "path:line") for a word that is no number.
    double number();
    /// A whole number in [least, most].
    int count(int least, int most);
    std::vector<double> numbers(std::size_t count);
    [[noreturn]] void fail(const std::string& why) const;

  private:
    struct Word {
        std::size_t begin, size;
        int line;
    };
    std::string path_, text_;
    std::vector<Word> words_;
    std::size_t next_ = 0;
};

}  // namespace asperity::io
