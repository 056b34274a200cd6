// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace asperity::cli {

/// The reader of standard output went away (`asperity info r | head -1`): nothing to tell anybody.
struct BrokenPipe {};

/// Makes writing to a closed pipe an error code, not a signal, and gives the standard streams a
/// file if they were closed, so that no output file takes their number.
void prepare_standard_streams();

/// Writes to standard output at once. Throws Error(InputOutput) when that fails, BrokenPipe.
/// Control characters but line ends and tabs, as file names may hold, become '?'.
void write_out(std::string_view text);

/// The same for the bytes of a file, as they are.
void write_bytes(std::string_view bytes);

/// Writes to standard error; failure is ignored, there is nobody left to tell.
/// Control characters as in write_out.
void write_err(std::string_view text);

/// The same for text of our own that moves the cursor.
void write_control(std::string_view text);

bool err_is_terminal();

/// Where the lines for human readers go: standard output; standard error when standard output is to
/// hold one JSON object; nowhere when the user wants quiet.
class Talk {
  public:
    Talk(bool quiet, bool json) : quiet_(quiet), json_(json) {}

    bool quiet() const { return quiet_; }
    bool json() const { return json_; }
    void operator()(std::string_view text) const;

  private:
    bool quiet_, json_;
};

}  // namespace asperity::cli
