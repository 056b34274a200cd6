// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace asperity::cli {

std::vector<std::string> verb_names(const CLI::App& program);

/// What an option of a verb (without its dashes, or a positional's name) may be, beside files and
/// numbers: the names its table or registry has.
std::vector<std::string> names_for(const CLI::App& verb, const std::string& option);

}  // namespace asperity::cli
