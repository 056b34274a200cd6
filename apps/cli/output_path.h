// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace asperity::cli {

/// Refuses, before anything is computed, an output file that could not be written in the end: its
/// folder is missing or closed to us, or the name is taken by a folder or a device. Throws
/// Error(InputOutput, path).
void check_output_file(const std::string& path);

/// The same for a folder that is to be made, if missing, and filled.
void check_output_folder(const std::string& path);

/// The name that stands for standard output.
inline constexpr const char* kStandardOutput = "-";

/// A file for writers that need a name, where the user asked for standard output.
class StandardOutputFile {
  public:
    /// Its name has this ending. Throws Error(InputOutput) without a place for temporary files, and
    /// Error(Usage) when standard output is a terminal, which shows no file.
    explicit StandardOutputFile(const std::string& ending);
    ~StandardOutputFile();
    StandardOutputFile(const StandardOutputFile&) = delete;
    StandardOutputFile& operator=(const StandardOutputFile&) = delete;

    const std::string& path() const { return path_; }
    /// Sends what was written. Throws as write_out.
    void send() const;

  private:
    std::string folder_, path_;
};

/// The ending of a file name in small letters, without the dot; empty when there is none.
std::string ending(const std::string& path);

}  // namespace asperity::cli
