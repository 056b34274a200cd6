// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/settings_text.h>

#include <asperity/core/parse_number.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Reads one line after another; `fail` knows which.
class SettingsReader {
  public:
    SettingsReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
        if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
    }

    std::vector<Setting> read() {
        std::vector<Setting> settings;
        while (!text_.empty()) {
            const std::size_t end = std::min(text_.find('\n'), text_.size());
            const std::string_view line = trimmed(text_.substr(0, end));
            text_.remove_prefix(std::min(end + 1, text_.size()));
            ++line_;
            if (line.empty() || line.front() == '#') continue;
            if (line.front() == '[')
                section_ = read_section(line);
            else
                settings.push_back(read_line(line));
        }
        return settings;
    }

  private:
    static bool is_name(std::string_view name) {
        return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
        });
    }

    std::string read_section(std::string_view line) const {
        const std::size_t end = line.find(']');
        const bool closed = end != std::string_view::npos;
        const std::string_view name = trimmed(line.substr(1, closed ? end - 1 : 0));
        if (!is_name(name) || !uncomment(line.substr(end + 1)).empty())
            fail(in_quotes(line) + " is no section '[name]'");
        return std::string(name);
    }

    Setting read_line(std::string_view line) const {
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) fail(in_quotes(line) + " is no 'key = value'");
        const std::string_view key = trimmed(line.substr(0, equals));
        if (!is_name(key)) fail(in_quotes(key) + " is no name of a setting");
        const std::string_view value = trimmed(line.substr(equals + 1));
        return {std::string(key), value.starts_with('"') ? unquote(value) : uncomment(value), line_,
                section_};
    }

    static std::string uncomment(std::string_view value) {
        return std::string(trimmed(value.substr(0, value.find('#'))));
    }

    // The text between double quotes, in which \" \\ \n \r stand for ", \ and line ends.
    std::string unquote(std::string_view value) const {
        std::string result;
        std::size_t k = 1;
        for (; k < value.size() && value[k] != '"'; ++k) {
            char c = value[k];
            if (c == '\\') {
                const char next = ++k < value.size() ? value[k] : '\0';
                if (next != '"' && next != '\\' && next != 'n' && next != 'r')
                    fail(R"(only \" \\ \n \r may follow a backslash within quotes)");
                c = next == 'n' ? '\n' : next == 'r' ? '\r' : next;
            }
            result += c;
        }
        if (k >= value.size()) fail("a closing double quote is missing");
        const std::string_view rest = trimmed(value.substr(k + 1));
        if (!rest.empty() && rest.front() != '#')
            fail(in_quotes(rest) + " follows the closing quote");
        return result;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, why, fmt::format("{}:{}", name_, line_));
    }

    std::string_view text_;
    const std::string& name_;
    int line_ = 0;
    std::string section_;
};

std::string quoted_if_needed(const std::string& value) {
    const bool plain = !value.empty() && trimmed(value) == value &&
                       value.find_first_of("#\"\\\n\r") == std::string::npos;
    if (plain) return value;
    std::string result = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n')
            result += "\\n";
        else if (c == '\r')
            result += "\\r";
        else
            result += c;
    }
    return result + "\"";
}

}  // namespace

std::vector<Setting> parse_settings(std::string_view text, const std::string& name) {
    return SettingsReader(text, name).read();
}

std::string setting_line(const std::string& key, const std::string& value) {
    return fmt::format("{} = {}\n", key, quoted_if_needed(value));
}

}  // namespace asperity
