// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace asperity::io {

/// Throws Error(Stopped) where `until`, if it is given, is asked to stop: for what writes a file.
void check_stop(const Run* until);

/// A file that is written whole or not at all.
///
/// The bytes go to a hidden temporary file in the same folder; commit() syncs it, renames it over
/// `path` and syncs the folder. Until then, and after any failure, what stood under `path` is as it
/// was. Destroyed without commit(), the temporary file is removed; what a killed program has left
/// is removed by the next AtomicFile of that name.
///
/// A device or a FIFO (/dev/stdout, /dev/full) cannot be renamed over: it is written directly.
/// Every member throws Error(InputOutput, path), with the words of the operating system. All files
/// that the project writes come through here: what goes wrong with a write is never lost.
class AtomicFile {
  public:
    /// Refuses a folder and a file that may not be written. Follows symbolic links. Once `until` is
    /// asked to stop, a write throws Error(Stopped) within a megabyte.
    explicit AtomicFile(std::string path, const Run* until = nullptr);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Appends `bytes`.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Where the next byte goes, from the beginning.
    std::uint64_t position() const { return static_cast<std::uint64_t>(position_); }
    /// Goes there, for a library that fills in tables when it knows them. Not on pipes.
    void seek(std::uint64_t position);
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
    const Run* until_ = nullptr;
    int descriptor_ = -1;
    bool direct_ = false;
    std::int64_t position_ = 0;
    std::int64_t started_ = 0;  ///< bytes on their way to the disk
};

/// Removes `path`, and what killed programs have left of writing it; that it is not there is no
/// error.
void remove_file(const std::string& path);

}  // namespace asperity::io
