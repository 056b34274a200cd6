// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace asperity::cli {

/// The page of the program in the manual, section 1, as roff: its verbs, exit codes, examples.
std::string program_manual(const CLI::App& program);

/// The page of a verb, asperity-VERB(1): what it takes, its options group by group, examples.
std::string verb_manual(const CLI::App& verb);

}  // namespace asperity::cli
