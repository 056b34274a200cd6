// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace asperity::cli {

/// Gives a verb its help page: a usage line, its options group by group with their defaults, and
/// the closing text (examples, each line as it is to be shown).
void set_help(CLI::App& app, const std::string& usage, const std::string& closing);

/// The line of set_help, with the program before it: "asperity info FILE".
std::string usage_of(const CLI::App& verb);

/// The verb of this name. Throws Error(Usage), with the one that was probably meant.
const CLI::App& find_verb(const CLI::App& program, const std::string& name);

/// Help of the program itself: its verbs instead of its options.
void set_program_help(CLI::App& program, const std::string& closing);

}  // namespace asperity::cli
