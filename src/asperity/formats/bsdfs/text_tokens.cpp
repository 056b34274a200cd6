// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/bsdfs/text_tokens.h>
#include <asperity/formats/read_file.h>

#include <fmt/format.h>

#include <cmath>

namespace asperity::io {

TextTokens::TextTokens(const std::string& path, int lines_left_out) : path_(path) {
    constexpr std::uint64_t kLargest = 1u << 30;
    text_ = read_text_file(path, kLargest);
    text_ = std::string(without_byte_order_mark(text_, path));
    int line = 1;
    bool line_begins = true;
    std::size_t at = 0;
    for (; line <= lines_left_out && at < text_.size(); ++line)
        at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
    while (at < text_.size()) {
        const char c = text_[at];
        if (c == '\n') {
            ++line;
            line_begins = true;
            ++at;
        } else if (c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v') {
            ++at;
        } else if (c == '#' && line_begins) {
            at = std::min(text_.find('\n', at), text_.size());
        } else {
            const std::size_t end = std::min(text_.find_first_of(" \t\r\n\f\v", at), text_.size());
            words_.push_back({at, end - at, line});
            line_begins = false;
            at = end;
        }
    }
}

std::string_view TextTokens::peek() const {
    if (at_end()) return {};
    return std::string_view(text_).substr(words_[next_].begin, words_[next_].size);
}

std::string_view TextTokens::word() {
    if (at_end()) throw Error(ErrorCode::InvalidInput, "ends too early", path_);
    const std::string_view word = peek();
    ++next_;
    return word;
}

bool TextTokens::take(std::string_view word) {
    if (at_end() || peek() != word) return false;
    ++next_;
    return true;
}

double TextTokens::number() {
    const std::string_view text = word();
    const auto value = parse_double(text);
    if (!value) {
        --next_;
        fail(in_quotes(text) + " is no number");
    }
    return *value;
}

int TextTokens::count(int least, int most) {
    const double value = number();
    if (!(value >= least && value <= most && value == std::floor(value))) {
        --next_;
        fail(fmt::format("{} is no whole number in {} .. {}", in_quotes(peek()), least, most));
    }
    return static_cast<int>(value);
}

std::vector<double> TextTokens::numbers(std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t k = 0; k < count; ++k) numbers.push_back(number());
    return numbers;
}

void TextTokens::fail(const std::string& why) const {
    const int line = words_.empty() ? 1 : words_[std::min(next_, words_.size() - 1)].line;
    throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", path_, line));
}

}  // namespace asperity::io
