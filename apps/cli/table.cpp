// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <algorithm>

namespace asperity::cli {

std::size_t display_width(const std::string& text) {
    // Bytes 10xxxxxx continue a character.
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

std::string Table::text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const auto& row : rows_) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            widths[c] = std::max(widths[c], display_width(row[c]));
        }
    }
    std::string text;
    for (const auto& row : rows_) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (c > 0) text += "  ";
            text.append(widths[c] - display_width(row[c]), ' ');
            text += row[c];
        }
        text += '\n';
    }
    return text;
}

}  // namespace asperity::cli
