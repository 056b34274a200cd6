// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
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

/// The whole file. Throws as InputFile, and Error(InvalidInput, path) for more than `max_bytes`.
std::vector<std::byte> read_file(const std::string& path, std::uint64_t max_bytes);
std::string read_text_file(const std::string& path, std::uint64_t max_bytes);

}  // namespace asperity::io
