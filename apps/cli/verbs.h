// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace asperity::cli {

/// A verb of the program: its options, and what it does once they are parsed. run() returns the
/// exit code and throws asperity::Error.
struct Verb {
    CLI::App* app = nullptr;
    std::function<int()> run;
};

// Each adds its verb to the program.
Verb add_surface(CLI::App& program);
Verb add_simulate(CLI::App& program);
Verb add_refine(CLI::App& program);
Verb add_merge(CLI::App& program);
Verb add_gloss(CLI::App& program);
Verb add_info(CLI::App& program);
Verb add_compare(CLI::App& program);
Verb add_fit(CLI::App& program);
Verb add_render(CLI::App& program);
Verb add_sheet(CLI::App& program);
Verb add_plot(CLI::App& program);
Verb add_export(CLI::App& program);
Verb add_reference(CLI::App& program);
Verb add_selftest(CLI::App& program);
Verb add_help(CLI::App& program);

}  // namespace asperity::cli
