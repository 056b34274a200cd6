// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace asperity::bench {

/// What a task found: a table for the eye, and all figures.
struct Report {
    std::string table;
    nlohmann::ordered_json figures;
};

/// One question, as a subcommand with options of its own.
struct Task {
    CLI::App* app = nullptr;
    std::function<Report()> run;
};

/// Tells whoever waits what comes next, on the error stream.
void say_next(const std::string& what);

}  // namespace asperity::bench
