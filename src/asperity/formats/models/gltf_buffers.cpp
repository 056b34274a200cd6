// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/models/gltf_buffers.h>

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/read_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace asperity::io::detail {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;         // "glTF"
constexpr std::uint32_t kJson = 0x4e4f534a;          // "JSON"
constexpr std::uint32_t kBinary = 0x004e4942;        // "BIN"
constexpr std::size_t kHeader = 12, kChunkHead = 8;  // bytes

std::uint32_t word_at(std::string_view file, std::size_t place) {
    std::uint32_t value;
    std::memcpy(&value, file.data() + place, sizeof value);
    return value;
}

bool is_binary(std::string_view file) {
    return file.size() >= kHeader && word_at(file, 0) == kMagic;
}

GltfContainer take_apart(std::string_view file, const std::string& path) {
    if (const std::uint32_t version = word_at(file, 4); version != 2)
        fail_at_byte(path, 4, fmt::format("glTF version {}, only 2 is read", version));
    const std::size_t end = word_at(file, 8);
    if (end > file.size() || end < kHeader)
        fail_at_byte(path, 8,
                     fmt::format("{} bytes are announced, the file has {}", end, file.size()));
    GltfContainer parts;
    bool has_json = false;
    for (std::size_t place = kHeader; place < end;) {
        if (end - place < kChunkHead) fail_at_byte(path, place, "the file ends inside a chunk");
        const std::size_t length = word_at(file, place);
        const std::uint32_t type = word_at(file, place + 4);
        place += kChunkHead;
        if (length > end - place)
            fail_at_byte(path, place - kChunkHead,
                         fmt::format("a chunk of {} bytes, {} are left", length, end - place));
        if (type == kJson && !has_json) {
            parts.json = std::string(file.substr(place, length));
            parts.json_start = place;
            has_json = true;
        } else if (type == kBinary && !parts.binary) {
            parts.binary = std::string(file.substr(place, length));
        }
        place += length;
    }
    if (!has_json) fail_at_byte(path, kHeader, "there is no JSON chunk");
    return parts;
}

int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0) return std::nullopt;
        bits = ((bits << 6) | static_cast<std::uint32_t>(value)) & 0xffff;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes += static_cast<char>(static_cast<unsigned char>(bits >> held));
    }
    return bytes;
}

/// "%20" and the like; a % without two hexadecimal digits stays.
std::string decode_percent(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto is_hex = [&](std::size_t at) {
            return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at])) != 0;
        };
        if (text[i] == '%' && is_hex(i + 1) && is_hex(i + 2)) {
            result += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

/// Whether the file lies in the model's folder or below it, by a name that fits on a line.
bool is_below(const std::filesystem::path& name) {
    const auto is_strange = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == ':' || c == '\\';
    };
    const std::string& text = name.native();
    return !name.empty() && name.is_relative() &&
           std::none_of(text.begin(), text.end(), is_strange) &&
           std::find(name.begin(), name.end(), "..") == name.end();
}

}  // namespace

GltfContainer open_gltf(const ModelSource& source) {
    std::string file = read_text_file(source.path, source.limits.file_bytes);
    if (is_binary(file)) return take_apart(file, source.path);
    const std::size_t mark = file.size() - without_byte_order_mark(file, source.path).size();
    return {file.substr(mark), mark, std::nullopt};
}

std::string_view GltfFiles::read(std::string_view uri) {
    const auto fail = [&](std::string why) {
        throw Error(ErrorCode::InvalidInput, std::move(why), source_.path);
    };
    if (uri.starts_with("data:")) {
        constexpr std::string_view kMark = ";base64,";
        const std::size_t mark = uri.find(kMark);
        if (mark == std::string_view::npos) fail("a data: URI that is not base64");
        auto bytes = decode_base64(uri.substr(mark + kMark.size()));
        if (!bytes) fail("a data: URI that is not base64");
        return keep(fmt::format("data:{}", files_.size()), *std::move(bytes));
    }
    const std::filesystem::path name = decode_percent(uri);
    if (!is_below(name))
        fail(fmt::format("buffer {} does not lie in the folder of the model", in_quotes(uri)));
    const auto folder = std::filesystem::path(source_.path).parent_path();
    const std::string path = (folder / name).string();
    // Two names of one file are one file.
    std::error_code error;
    const std::string place = std::filesystem::canonical(path, error).string();
    const auto known = files_.find(place);
    if (!error && known != files_.end()) return known->second;
    const std::uint64_t left = source_.limits.file_bytes - bytes_read_;
    return keep(error ? path : place, read_text_file(path, left));
}

std::string_view GltfFiles::keep(const std::string& name, std::string bytes) {
    bytes_read_ += bytes.size();
    return files_[name] = std::move(bytes);
}

}  // namespace asperity::io::detail
