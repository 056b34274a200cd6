// SPDX-License-Identifier: Apache-2.0
// What do exact reflectances of a metal in three channels, kept apart by reflections, cost over
// perfect mirrors?
#include "averages.h"
#include "product_run.h"
#include "product_tasks.h"
#include "task_options.h"

#include <fmt/format.h>

#include <memory>

namespace asperity::bench {

namespace {

struct FresnelOptions {
    std::vector<std::string> surfaces = {"gaussian-0.3", "thesis-0.2", "thesis-1"};
    int size = 512;
    std::vector<double> thetas = {0, 45, 80};
    double seconds = 0.15;
    int repetitions = 5;
};

Experiment mirrors(double theta_deg) {
    Experiment experiment = bench_experiment(theta_deg, 0);
    experiment.detector.orders = 1;
    return experiment;
}

Experiment gold(double theta_deg) {
    Experiment experiment = bench_experiment(theta_deg, 0);
    experiment.detector.orders = 4;
    experiment.optics.fresnel = FresnelKind::Conductor;
    experiment.optics.material = "Au";
    return experiment;
}

/// Adds the row of a surface and an angle.
void add_row(const std::string& name, const Heightfield& surface, double theta,
             const FresnelOptions& options, Report& report) {
    Experiment plain = mirrors(theta), metal = gold(theta);
    plain.run.rays = rays_for_seconds(surface, plain, options.seconds);
    metal.run.rays = plain.run.rays;
    const double plain_setup = setup_cpu_seconds(surface, plain);
    const double metal_setup = setup_cpu_seconds(surface, metal);
    const auto rays = static_cast<double>(plain.run.rays);
    // In turns, and the median of the ratios: what else the machine does falls on both
    std::vector<double> plain_costs, metal_costs, ratios;
    for (int repetition = 0; repetition < options.repetitions; ++repetition) {
        const double plain_seconds = timed_measure(surface, plain, 1).cpu_seconds;
        const double metal_seconds = timed_measure(surface, metal, 1).cpu_seconds;
        plain_costs.push_back((plain_seconds - plain_setup) / rays);
        metal_costs.push_back((metal_seconds - metal_setup) / rays);
        ratios.push_back(metal_costs.back() / plain_costs.back());
    }
    const double plain_speed = 1 / median(plain_costs), metal_speed = 1 / median(metal_costs);
    report.table +=
        fmt::format("{:<14}{:>6.0f}{:>12}{:>12.3f}{:>12.3f}{:>8.3f}\n", name, theta, plain.run.rays,
                    plain_speed / 1e6, metal_speed / 1e6, median(ratios));
    report.figures.push_back({{"surface", name},
                              {"size", options.size},
                              {"theta_deg", theta},
                              {"rays", plain.run.rays},
                              {"mirrors_paths_per_second", plain_speed},
                              {"gold_paths_per_second", metal_speed},
                              {"relative_cost", median(ratios)}});
}

Report run_fresnel(const FresnelOptions& options) {
    Report report;
    report.table = fmt::format(
        "Fresnel: gold in RGB with 4 orders over perfect mirrors with 1, N = {}, one thread\n"
        "{:<14}{:>6}{:>12}{:>12}{:>12}{:>8}\n",
        options.size, "surface", "theta", "rays", "mirrors M/s", "gold M/s", "cost");
    for (const std::string& name : options.surfaces) {
        const Heightfield surface = make_bench_surface(name, options.size);
        for (const double theta : options.thetas) {
            say_next(fmt::format("{} at {}°", name, theta));
            add_row(name, surface, theta, options, report);
        }
    }
    return report;
}

}  // namespace

Task add_fresnel(CLI::App& program) {
    const auto options = std::make_shared<FresnelOptions>();
    CLI::App* app = program.add_subcommand("fresnel", "a metal beside perfect mirrors");
    add_surface(*app, options->surfaces);
    add_size(*app, options->size);
    add_theta(*app, options->thetas);
    app->add_option("--seconds", options->seconds, "the mirrors' work in a repetition, about")
        ->capture_default_str();
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_fresnel(*options); }};
}

}  // namespace asperity::bench
