// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace asperity::cli {

namespace {

/// A head in lines of at most `width` characters, as far as its words allow.
std::vector<std::string> lines_of(const std::string& head, std::size_t width) {
    std::vector<std::string> lines;
    std::istringstream words(head);
    for (std::string word; words >> word;) {
        const bool joins =
            !lines.empty() && display_width(lines.back()) + 1 + display_width(word) <= width;
        if (joins)
            lines.back() += ' ' + word;
        else
            lines.push_back(word);
    }
    return lines;
}

std::size_t longest_word(const std::string& head) {
    std::size_t longest = 0;
    for (const std::string& word : lines_of(head, 0))
        longest = std::max(longest, display_width(word));
    return longest;
}

std::size_t width_of(const std::vector<std::size_t>& columns,
                     const std::vector<std::size_t>& widths, std::size_t gap) {
    std::size_t sum = columns.empty() ? 0 : gap * (columns.size() - 1);
    for (const std::size_t c : columns) sum += widths[c];
    return sum;
}

void append_cell(std::string& text, const std::string& cell, std::size_t width, std::size_t gap) {
    text.append(gap + width - display_width(cell), ' ');
    text += cell;
}

void end_line(std::string& text) {
    while (!text.empty() && text.back() == ' ') text.pop_back();
    text += '\n';
}

}  // namespace

std::size_t display_width(const std::string& text) {
    // Bytes 10xxxxxx continue a character.
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

std::vector<std::size_t> Table::widths(bool whole_heads) const {
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < heads_.size(); ++c) {
        widths.push_back(whole_heads ? display_width(heads_[c]) : longest_word(heads_[c]));
        for (const auto& row : rows_) widths[c] = std::max(widths[c], display_width(row[c]));
    }
    return widths;
}

std::string Table::block(const Columns& columns, const std::vector<std::size_t>& widths,
                         std::size_t gap) const {
    std::string text;
    std::size_t height = 0;
    for (const std::size_t c : columns)
        height = std::max(height, lines_of(heads_[c], widths[c]).size());
    for (std::size_t line = 0; line < height; ++line) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const auto head = lines_of(heads_[columns[k]], widths[columns[k]]);
            const std::size_t above = height - head.size();
            append_cell(text, line < above ? "" : head[line - above], widths[columns[k]],
                        k == 0 ? 0 : gap);
        }
        end_line(text);
    }
    for (const auto& row : rows_) {
        const bool empty = std::all_of(columns.begin(), columns.end(),
                                       [&](std::size_t c) { return c < keys_ || row[c].empty(); });
        if (empty) continue;
        for (std::size_t k = 0; k < columns.size(); ++k)
            append_cell(text, row[columns[k]], widths[columns[k]], k == 0 ? 0 : gap);
        end_line(text);
    }
    return text;
}

std::string Table::text() const {
    Columns all(heads_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::vector<std::size_t> wide = this->widths(true), widths = this->widths(false);
    if (width_of(all, wide, 2) <= kTableColumns) return block(all, wide, 2);
    for (const std::size_t gap : {2u, 1u})
        if (width_of(all, widths, gap) <= kTableColumns) return block(all, widths, gap);

    const Columns keys(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(keys_));
    std::string text;
    Columns columns = keys;
    for (std::size_t c = keys_; c < all.size(); ++c) {
        columns.push_back(c);
        if (width_of(columns, widths, 2) <= kTableColumns || columns.size() == keys_ + 1) continue;
        columns.pop_back();
        text += block(columns, widths, 2) + '\n';
        columns = keys;
        columns.push_back(c);
    }
    return text + block(columns, widths, 2);
}

}  // namespace asperity::cli
