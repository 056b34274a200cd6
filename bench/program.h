// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "task.h"

#include <functional>
#include <initializer_list>
#include <string>

namespace asperity::bench {

/// What main() of the program `name` returns: the result of `body`, or 1 after a line about what
/// went wrong.
int guarded_main(const std::string& name, const std::function<int()>& body);

/// Adds a task to a program.
using AddTask = Task (*)(CLI::App& program);

/// A program whose subcommands are tasks: runs those asked for, or all, and prints their tables.
/// --json adds the figures to a file, each task's as the section `section` + its name. Returns the
/// exit code.
int run_tasks(const std::string& about, std::initializer_list<AddTask> tasks,
              const std::string& section, int argc, char** argv);

}  // namespace asperity::bench
