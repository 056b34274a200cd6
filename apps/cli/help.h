// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace asperity::cli {

/// Gives a verb its help page: a usage line, its options group by group with their defaults, and
/// the closing text (examples, each line as it is to be shown).
void set_help(CLI::App& app, const std::string& usage, const std::string& closing);

/// Help of the program itself: its verbs instead of its options.
void set_program_help(CLI::App& program, const std::string& closing);

}  // namespace asperity::cli
