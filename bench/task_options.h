// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace asperity::bench {

// Options that several programs and tasks have; help shows the values the variables have now.

/// --surface: names of surfaces.h.
void add_surface(CLI::App& app, std::string& surface);
void add_surface(CLI::App& app, std::vector<std::string>& surfaces);
/// --size: N.
void add_size(CLI::App& app, int& size);
/// --theta.
void add_theta(CLI::App& app, double& theta_deg);
void add_theta(CLI::App& app, std::vector<double>& thetas_deg);
/// --repetitions: of which the median counts.
void add_repetitions(CLI::App& app, int& repetitions);

}  // namespace asperity::bench
