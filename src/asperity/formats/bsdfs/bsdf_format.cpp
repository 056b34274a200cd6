// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/bsdfs/builtin_formats.h>
#include <asperity/formats/read_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>

namespace asperity::io {
namespace {

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

bool has_ending(const BsdfFormat& format, const std::string& ending) {
    return std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end();
}

std::string first_bytes(const std::string& path) {
    const InputFile file(path);
    std::string head(std::min<std::uint64_t>(file.size(), kSniffedBytes), '\0');
    file.read(0, std::as_writable_bytes(std::span(head)));
    return head;
}

}  // namespace

BsdfFormats::BsdfFormats() : rows_(builtin_formats()) {}

void BsdfFormats::add(BsdfFormat format) {
    if (find(format.name))
        throw Error(ErrorCode::Usage, "there is a format of this name", format.name);
    rows_.insert(rows_.begin(), std::move(format));
}

const BsdfFormat* BsdfFormats::find(std::string_view name) const {
    for (const BsdfFormat& format : rows_)
        if (format.name == name) return &format;
    return nullptr;
}

const BsdfFormat& BsdfFormats::for_writing(const std::string& path, const std::string& name) const {
    std::vector<std::string> names, endings;
    const std::string ending = ending_of(path);
    for (const BsdfFormat& format : rows_) {
        if (!format.write) continue;
        if (name.empty() ? has_ending(format, ending) : format.name == name) return format;
        names.push_back(format.name);
        for (const std::string& known : format.endings)
            if (std::find(endings.begin(), endings.end(), known) == endings.end())
                endings.push_back(known);
    }
    if (!name.empty())
        throw Error(ErrorCode::Usage,
                    fmt::format("{} is none of {}", in_quotes(name), fmt::join(names, ", ")),
                    "format");
    throw Error(ErrorCode::Usage,
                fmt::format("the name must end in .{} or name a format", fmt::join(endings, ", .")),
                path);
}

const BsdfFormat* BsdfFormats::for_reading(const std::string& path) const {
    const std::string head = first_bytes(path);
    for (const BsdfFormat& format : rows_)
        if (format.read && format.recognises && format.recognises(head)) return &format;
    // A result of ours has a reader of its own.
    if (head.starts_with(std::string_view("tensor_file", 12))) return nullptr;
    for (const BsdfFormat& format : rows_)
        if (format.read && has_ending(format, ending_of(path))) return &format;
    return nullptr;
}

bool BsdfFormats::can_read(const std::string& path) const {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) && for_reading(path) != nullptr;
}

std::unique_ptr<Bsdf> BsdfFormats::read(const std::string& path) const {
    const BsdfFormat* format = for_reading(path);
    if (!format)
        throw Error(ErrorCode::InvalidInput, "is of none of the formats that can be read", path);
    try {
        return format->read(path);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

}  // namespace asperity::io
