// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace asperity {

/// The name nearest to what was typed, counting letters added, dropped, changed or swapped; empty
/// when none is near enough to be meant.
std::string nearest(const std::string& typed, const std::vector<std::string>& names);

/// "; did you mean NAME?" or nothing.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& names);

}  // namespace asperity
