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

/// The ending of a file name in small letters, without the dot; empty when there is none.
std::string ending(const std::string& path);

}  // namespace asperity::cli
