// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace asperity {

/// `text` from somebody's file, fit for a line of output: control characters and bytes that are no
/// UTF-8 become '?'.
std::string printable(std::string_view text);

}  // namespace asperity
