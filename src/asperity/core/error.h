// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace asperity {

/// What kind of mistake or mishap an Error reports. The values are the exit codes of the programs.
enum class ErrorCode {
    Usage = 2,         ///< a setting outside its range, settings that contradict each other
    InvalidInput = 3,  ///< a file whose content is not what it claims to be
    InputOutput = 4,   ///< the operating system refused to open, read, write or rename
    OutOfMemory = 5,   ///< more memory needed than there is
    Account = 6,       ///< energy is not accounted for: a fault of this program or the machine
    Stopped = 130,     ///< the user asked to stop
};

/// The one exception type of the library. Thrown while setting up, reading and writing; the tracing
/// kernels never throw.
///
/// `where` is the place in the user's world: "file.gsf", "heights.txt:12" or the name of a setting.
/// what() is "where: message", or the message alone when `where` is empty: one line, no full stop.
class Error : public std::runtime_error {
  public:
    Error(ErrorCode code, std::string message, std::string where = {})
        : std::runtime_error(where.empty() ? message : where + ": " + message),
          code_(code),
          message_(std::move(message)),
          where_(std::move(where)) {}

    ErrorCode code() const noexcept { return code_; }
    const std::string& message() const noexcept { return message_; }
    const std::string& where() const noexcept { return where_; }

  private:
    ErrorCode code_;
    std::string message_, where_;
};

}  // namespace asperity
