// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace asperity::bench {

/// Writes `figures` into the JSON file `path` as `section`, beside the sections of other programs
/// that are there already, and the processor they ran on. Throws std::runtime_error.
void add_to_json(const std::string& path, const std::string& section,
                 const nlohmann::ordered_json& figures);

}  // namespace asperity::bench
