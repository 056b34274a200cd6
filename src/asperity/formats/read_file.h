// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// A regular file open for reading at any place.
///
/// Throws Error(InputOutput, path): missing, not readable, a folder, a device or a FIFO.
class InputFile {
  public:
    explicit InputFile(std::string path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& path() const { return path_; }
    /// Bytes in the file when it was opened.
    std::uint64_t size() const { return size_; }

    /// Fills `bytes` from byte `offset` on. Throws Error(InputOutput) when the file ends before.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  private:
    std::string path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// What tells a format by its content.
struct FileStart {
    std::string bytes;  ///< the first of the file, up to 4096
    std::uint64_t size = 0;
};
/// Throws as InputFile.
FileStart read_start(const std::string& path);

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// `text` without the byte order mark that some programs put in front of UTF-8. Throws
/// Error(InvalidInput, path) when the mark says UTF-16, which no reader of ours takes.
std::string_view without_byte_order_mark(std::string_view text, const std::string& path);

/// The whole file. Throws as InputFile, and Error(InvalidInput, path) for more than `max_bytes`.
std::vector<std::byte> read_file(const std::string& path, std::uint64_t max_bytes);
std::string read_text_file(const std::string& path, std::uint64_t max_bytes);

}  // namespace asperity::io
