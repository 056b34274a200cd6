// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/heights/heights_format.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/printable.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace asperity::io {
namespace {

std::string names_of(const std::vector<HeightsFormat>& rows) {
    std::string names;
    for (const HeightsFormat& row : rows)
        if (row.open) names += (names.empty() ? "" : ", ") + row.name;
    return names;
}

bool has_ending(const HeightsFormat& row, const std::string& ending) {
    return std::find(row.endings.begin(), row.endings.end(), ending) != row.endings.end();
}

std::string list_text(const std::vector<HeightsChannel>& channels) {
    std::string text;
    for (std::size_t k = 0; k < channels.size(); ++k)
        text += fmt::format("{}{} {}", k == 0 ? "" : ", ", k + 1, in_quotes(channels[k].name));
    return text;
}

// The channel of this number, else of this name; two of one name are told apart by number.
const HeightsChannel& chosen(const std::vector<HeightsChannel>& channels,
                             const HeightsSource& source) {
    const std::string& wish = source.options().channel;
    const auto number = parse_integer<std::size_t>(wish);
    if (number && *number >= 1 && *number <= channels.size()) return channels[*number - 1];
    const HeightsChannel* found = nullptr;
    for (const HeightsChannel& channel : channels) {
        if (channel.name != wish) continue;
        if (found != nullptr)
            source.refuse(
                fmt::format("several channels are named {}: choose by number with "
                            "--channel ({})",
                            in_quotes(wish), list_text(channels)));
        found = &channel;
    }
    if (found == nullptr)
        source.refuse(
            fmt::format("there is no channel {}: {}", in_quotes(wish), list_text(channels)));
    return *found;
}

const HeightsChannel& only_heights(const std::vector<HeightsChannel>& channels,
                                   const HeightsSource& source) {
    const HeightsChannel* found = nullptr;
    for (const HeightsChannel& channel : channels) {
        if (!channel.other.empty()) continue;
        if (found != nullptr)
            source.refuse(fmt::format("several channels hold heights: --channel chooses ({})",
                                      list_text(channels)));
        found = &channel;
    }
    if (found == nullptr)
        source.refuse(fmt::format("no channel holds heights ({})",
                                  channels.empty() ? "there is none" : list_text(channels)));
    return *found;
}

}  // namespace

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

HeightsFormats::HeightsFormats() : rows_(builtin_heights()) {}

void HeightsFormats::add(HeightsFormat format) {
    if (find(format.name) != nullptr)
        throw Error(ErrorCode::Usage, "there is a format of this name already", format.name);
    rows_.insert(rows_.begin(), std::move(format));
}

const HeightsFormat* HeightsFormats::find(std::string_view name) const {
    for (const HeightsFormat& row : rows_)
        if (row.name == name) return &row;
    return nullptr;
}

const HeightsFormat& HeightsFormats::for_reading(const HeightsSource& source) const {
    if (const std::string& wish = source.options().format; !wish.empty()) {
        const HeightsFormat* row = find(wish);
        if (row == nullptr || !row->open)
            throw Error(ErrorCode::Usage,
                        fmt::format("{} is none of {}", in_quotes(wish), names_of(rows_)),
                        "format");
        return *row;
    }
    for (const HeightsFormat& row : rows_)
        if (row.open && row.recognises && row.recognises(source.head())) return row;
    const std::string ending = ending_of(source.path());
    for (const HeightsFormat& row : rows_)
        if (row.open && has_ending(row, ending)) return row;
    source.refuse(
        fmt::format("neither its first bytes nor its ending {} are of a format of heights read "
                    "here ({}); other formats can be read in Python and handed over as an array, "
                    "or converted to .gsf",
                    in_quotes(ending), names_of(rows_)));
}

const HeightsFormat& HeightsFormats::for_writing(const std::string& path) const {
    const std::string ending = ending_of(path);
    std::string known;
    for (const HeightsFormat& row : rows_) {
        if (!row.write) continue;
        if (has_ending(row, ending)) return row;
        known += (known.empty() ? "." : ", .") + row.endings.front();
    }
    throw Error(
        ErrorCode::Usage,
        fmt::format("heights are written to {} files, not {}", known, in_quotes("." + ending)),
        path);
}

std::vector<HeightsChannel> HeightsFormats::list(const HeightsSource& source) const {
    std::vector<HeightsChannel> channels = for_reading(source).open(source);
    for (HeightsChannel& channel : channels) channel.name = printable(channel.name);
    return channels;
}

Topography HeightsFormats::read(const HeightsSource& source) const {
    const std::vector<HeightsChannel> channels = list(source);
    const HeightsChannel& channel = source.options().channel.empty()
                                        ? only_heights(channels, source)
                                        : chosen(channels, source);
    if (!channel.other.empty())
        source.refuse(
            fmt::format("channel {} holds no heights: {}", in_quotes(channel.name), channel.other));
    Topography topography = channel.read();
    if (topography.name.empty()) topography.name = source.path();
    for (std::string* text :
         {&topography.name, &topography.found, &topography.assumed, &topography.prepared})
        *text = printable(*text);
    return topography;
}

}  // namespace asperity::io
