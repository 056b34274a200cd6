// SPDX-License-Identifier: Apache-2.0
#include "task_options.h"

#include "surfaces.h"

namespace asperity::bench {

namespace {

constexpr const char* kTheta = "of incidence [degrees]";

}  // namespace

void add_surface(CLI::App& app, std::string& surface) {
    app.add_option("--surface", surface)
        ->check(CLI::IsMember(surface_names()))
        ->capture_default_str();
}

void add_surface(CLI::App& app, std::vector<std::string>& surfaces) {
    app.add_option("--surface", surfaces)
        ->check(CLI::IsMember(surface_names()))
        ->delimiter(',')
        ->capture_default_str();
}

void add_size(CLI::App& app, int& size) {
    app.add_option("--size", size, "samples on a side")
        ->check(CLI::Range(2, kMaxSurfaceSide))
        ->capture_default_str();
}

void add_theta(CLI::App& app, double& theta_deg) {
    app.add_option("--theta", theta_deg, kTheta)->capture_default_str();
}

void add_theta(CLI::App& app, std::vector<double>& thetas_deg) {
    app.add_option("--theta", thetas_deg, kTheta)->delimiter(',')->capture_default_str();
}

void add_repetitions(CLI::App& app, int& repetitions) {
    app.add_option("--repetitions", repetitions, "of which the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
}

}  // namespace asperity::bench
