// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/read_file.h>

#include <asperity/core/error.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace asperity::io {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::InputOutput, why, path);
}

[[noreturn]] void refuse_with_errno(const std::string& path, const char* what) {
    refuse(path, fmt::format("{}: {}", what, std::system_category().message(errno)));
}

template <typename Bytes>
Bytes read_whole(const std::string& path, std::uint64_t max_bytes) {
    const InputFile file(path);
    if (file.size() > max_bytes)
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} bytes are more than the {} allowed", file.size(), max_bytes),
                    path);
    Bytes bytes(static_cast<std::size_t>(file.size()), typename Bytes::value_type{});
    file.read(0, std::as_writable_bytes(std::span(bytes)));
    return bytes;
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
    // O_NONBLOCK: a FIFO without a writer must be refused, not waited for.
    do {
        descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    } while (descriptor_ < 0 && errno == EINTR);
    if (descriptor_ < 0) refuse_with_errno(path_, "cannot open");

    struct ::stat status {};
    const bool known = ::fstat(descriptor_, &status) == 0;
    if (known && S_ISREG(status.st_mode)) {
        size_ = static_cast<std::uint64_t>(status.st_size);
        return;
    }
    ::close(descriptor_);
    if (!known) refuse(path_, "cannot ask for its size");
    refuse(path_, S_ISDIR(status.st_mode) ? "cannot read: it is a folder"
                                          : "cannot read: it is not a regular file");
}

InputFile::~InputFile() {
    ::close(descriptor_);
}

void InputFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_with_errno(path_, "cannot read");
        if (count == 0) refuse(path_, fmt::format("ends early, at byte {}", offset));
        offset += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

FileStart read_start(const std::string& path) {
    constexpr std::uint64_t kMost = 4096;
    const InputFile file(path);
    FileStart start{std::string(static_cast<std::size_t>(std::min(file.size(), kMost)), '\0'),
                    file.size()};
    file.read(0, std::as_writable_bytes(std::span(start.bytes)));
    return start;
}

std::string_view without_byte_order_mark(std::string_view text, const std::string& path) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw Error(ErrorCode::InvalidInput, "it is text in UTF-16, save it as UTF-8", path);
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return text;
}

std::vector<std::byte> read_file(const std::string& path, std::uint64_t max_bytes) {
    return read_whole<std::vector<std::byte>>(path, max_bytes);
}

std::string read_text_file(const std::string& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

}  // namespace asperity::io
