// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace asperity::io {

/// A file that is written whole or not at all.
///
/// The bytes go to a hidden temporary file in the same folder; commit() syncs it, renames it over
/// `path` and syncs the folder. Until then, and after any failure, what stood under `path` is as it
/// was. Destroyed without commit(), the temporary file is removed.
///
/// A device or a FIFO (/dev/stdout, /dev/full) cannot be renamed over: it is written directly.
/// Every member throws Error(InputOutput, path), with the words of the operating system.
class AtomicFile {
  public:
    /// Refuses a folder and a file that may not be written. Follows symbolic links.
    explicit AtomicFile(std::string path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Appends `bytes`.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// The name under which a library that opens its file by itself shall write, instead of calls
    /// of write(). The file is there already, and empty; the library must close it before commit().
    const std::string& temporary_path() const { return temporary_; }
    const std::string& path() const { return path_; }

    /// Puts the file in place. Call once, as the last thing.
    void commit();

  private:
    void open_temporary();
    void start_writing_back();
    [[noreturn]] void fail(const char* what) const;
    void close_and_remove() noexcept;

    std::string path_;       ///< as the user gave it
    std::string target_;     ///< the same with symbolic links resolved
    std::string temporary_;  ///< what is being written; target_ itself when `direct_`
    int descriptor_ = -1;
    bool direct_ = false;
    std::int64_t written_ = 0;  ///< bytes, by write()
    std::int64_t started_ = 0;  ///< of them on their way to the disk
};

}  // namespace asperity::io
