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

/// One question about the product, as a subcommand with options of its own.
struct Task {
    CLI::App* app = nullptr;
    std::function<Report()> run;
};

Task add_growth(CLI::App& program);
Task add_threads(CLI::App& program);
Task add_fresnel(CLI::App& program);
Task add_stages(CLI::App& program);

}  // namespace asperity::bench
