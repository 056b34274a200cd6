// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace asperity::cli {

/// Columns that fit a terminal everywhere.
inline constexpr std::size_t kTableColumns = 80;

/// A table of text: columns as wide as their widest cell, all right-aligned. Heads of several words
/// stand on several lines where that keeps a column narrow.
class Table {
  public:
    /// The first `keys` columns name a row.
    explicit Table(std::vector<std::string> heads, std::size_t keys = 1)
        : heads_(std::move(heads)), keys_(keys) {}

    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    /// All lines, each ended by a newline. Two spaces between columns, or one where the table would
    /// else be too wide; what is still too wide goes on below, behind the same keys, without the
    /// rows that are empty there.
    std::string text() const;

  private:
    using Columns = std::vector<std::size_t>;

    std::vector<std::size_t> widths(bool whole_heads) const;
    std::string block(const Columns& columns, const std::vector<std::size_t>& widths,
                      std::size_t gap) const;

    std::vector<std::string> heads_;
    std::vector<std::vector<std::string>> rows_;
    std::size_t keys_;
};

/// Number of characters of UTF-8 text.
std::size_t display_width(const std::string& text);

}  // namespace asperity::cli
