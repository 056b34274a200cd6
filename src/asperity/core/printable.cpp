// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/printable.h>

#include <cstddef>
#include <cstdint>

namespace asperity {

namespace {

std::uint32_t byte_at(std::string_view text, std::size_t k) {
    return static_cast<unsigned char>(text[k]);
}

/// Bytes of the UTF-8 character that `text` begins with; 0 when it begins with none.
std::size_t character_bytes(std::string_view text) {
    const std::uint32_t first = byte_at(text, 0);
    if (first < 0x80) return 1;
    const std::size_t count = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < count) return 0;
    std::uint32_t code = first & (0x7fu >> count);
    for (std::size_t k = 1; k < count; ++k) {
        if ((byte_at(text, k) & 0xc0u) != 0x80) return 0;
        code = code << 6 | (byte_at(text, k) & 0x3fu);
    }
    const bool overlong = (count == 3 && code < 0x800) || (count == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return overlong || surrogate || code > 0x10ffff ? 0 : count;
}

/// The second half of the control characters, U+0080 .. U+009F, too.
bool is_control(std::string_view character) {
    const std::uint32_t first = byte_at(character, 0);
    return first < 0x20 || first == 0x7f || (first == 0xc2 && byte_at(character, 1) < 0xa0);
}

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t count = character_bytes(text);
        if (count == 0 || is_control(text))
            result += '?';
        else
            result += text.substr(0, count);
        text.remove_prefix(count == 0 ? 1 : count);
    }
    return result;
}

}  // namespace asperity
