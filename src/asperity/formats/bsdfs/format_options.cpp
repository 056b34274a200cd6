// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/bsdfs/format_options.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace asperity::io {

FormatOptions::FormatOptions(const std::vector<FormatOption>& known, std::string_view text) {
    std::vector<std::string> names;
    for (const FormatOption& option : known) {
        values_[option.name] = option.otherwise;
        names.push_back(option.name);
    }
    if (trimmed(text).empty()) return;
    std::set<std::string> given;
    for (const std::string_view piece : split(text, ',')) {
        const std::size_t equals = piece.find('=');
        const std::string name(trimmed(piece.substr(0, equals)));
        if (equals == std::string_view::npos)
            throw Error(ErrorCode::Usage, in_quotes(piece) + " is not of the form key=value",
                        "format");
        if (!values_.contains(name))
            throw Error(ErrorCode::Usage,
                        names.empty() ? in_quotes(name) + ": this format has no options"
                                      : fmt::format("{} is no option of this format; there are {}",
                                                    in_quotes(name), fmt::join(names, ", ")),
                        "format");
        if (!given.insert(name).second) throw Error(ErrorCode::Usage, "is given twice", name);
        values_[name] = std::string(trimmed(piece.substr(equals + 1)));
    }
}

const std::string& FormatOptions::text(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw Error(ErrorCode::Usage, "is no option of the format", name);
    return found->second;
}

int FormatOptions::count(const std::string& name, int least, int most, int otherwise) const {
    const std::string& value = text(name);
    if (value.empty()) return otherwise;
    const auto number = parse_integer<int>(value);
    if (!number || *number < least || *number > most)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is no whole number of {} .. {}", in_quotes(value), least, most),
                    name);
    return *number;
}

double FormatOptions::number(const std::string& name, double least, double most,
                             double otherwise) const {
    const std::string& value = text(name);
    if (value.empty()) return otherwise;
    const auto number = parse_double(value);
    if (!number || *number < least || *number > most)
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is no number of {} .. {}", in_quotes(value), least, most),
                    name);
    return *number;
}

std::string FormatOptions::word(const std::string& name,
                                const std::vector<std::string>& words) const {
    const std::string& value = text(name);
    if (value.empty()) return words.front();
    if (std::find(words.begin(), words.end(), value) == words.end())
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is none of {}", in_quotes(value), fmt::join(words, ", ")),
                    name);
    return value;
}

}  // namespace asperity::io
