// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace asperity::cli {

/// A table of text: columns as wide as their widest cell, all right-aligned, two spaces between.
class Table {
  public:
    explicit Table(std::vector<std::string> heads) : rows_{std::move(heads)} {}

    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    /// All lines, each ended by a newline.
    std::string text() const;

  private:
    std::vector<std::vector<std::string>> rows_;  ///< the first row holds the heads
};

/// Number of characters of UTF-8 text.
std::size_t display_width(const std::string& text);

}  // namespace asperity::cli
