// SPDX-License-Identifier: Apache-2.0
// What does light from all around, averaged over its azimuth, cost over light of one azimuth?
#include "averages.h"
#include "product_run.h"
#include "product_tasks.h"
#include "surfaces.h"
#include "task_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace asperity::bench {

namespace {

struct AroundOptions {
    std::vector<std::string> surfaces = surface_names();
    int size = 512;
    std::vector<double> thetas = {0, 45, 80};
    double rays_per_cell = 8;
    int repetitions = 5;
};

Experiment experiment_of(double theta_deg, std::uint64_t rays, bool gold, bool around) {
    Experiment experiment = bench_experiment(theta_deg, rays);
    experiment.detector.orders = gold ? 4 : 1;
    if (gold) {
        experiment.optics.fresnel = FresnelKind::Conductor;
        experiment.optics.material = "Au";
    }
    if (around) {
        experiment.illumination.phi_deg = {0};
        experiment.illumination.isotropic = true;
    }
    return experiment;
}

/// Adds the row of a surface, an angle and a reflectance; returns the ratio of the speeds.
double add_row(const std::string& name, const Heightfield& surface, double theta, bool gold,
               const AroundOptions& options, Report& report) {
    const auto rays = static_cast<std::uint64_t>(options.rays_per_cell *
                                                 static_cast<double>(surface.cell_count()));
    const Experiment fixed = experiment_of(theta, rays, gold, false),
                     around = experiment_of(theta, rays, gold, true);
    // A surface is made ready once, however many layers there are
    const double setup =
        std::min(setup_cpu_seconds(surface, fixed), setup_cpu_seconds(surface, around));
    // In turns, and the median of the ratios: what else the machine does falls on both
    std::vector<double> fixed_costs, around_costs, ratios;
    for (int repetition = 0; repetition < options.repetitions; ++repetition) {
        const double a = timed_measure(surface, fixed, 1).cpu_seconds - setup;
        const double b = timed_measure(surface, around, 1).cpu_seconds - setup;
        fixed_costs.push_back(a / static_cast<double>(rays));
        around_costs.push_back(b / static_cast<double>(rays));
        ratios.push_back(a / b);
    }
    const double fixed_speed = 1 / median(fixed_costs), around_speed = 1 / median(around_costs);
    report.table += fmt::format("{:<14}{:>6.0f}{:>9}{:>12}{:>12.2f}{:>12.2f}{:>8.2f}\n", name,
                                theta, gold ? "gold" : "mirrors", rays, fixed_speed / 1e6,
                                around_speed / 1e6, median(ratios));
    report.figures.push_back({{"surface", name},
                              {"size", options.size},
                              {"theta_deg", theta},
                              {"gold", gold},
                              {"rays", rays},
                              {"fixed_paths_per_second", fixed_speed},
                              {"isotropic_paths_per_second", around_speed},
                              {"ratio", median(ratios)}});
    return median(ratios);
}

Report run_around(const AroundOptions& options) {
    Report report;
    report.table = fmt::format(
        "Isotropic: light from all around beside light of one azimuth, N = {}, one thread\n"
        "{:<14}{:>6}{:>9}{:>12}{:>12}{:>12}{:>8}\n",
        options.size, "surface", "theta", "facets", "rays", "fixed M/s", "isotr. M/s", "ratio");
    std::vector<double> ratios;
    for (const std::string& name : options.surfaces) {
        const Heightfield surface = make_bench_surface(name, options.size);
        for (const double theta : options.thetas)
            for (const bool gold : {false, true}) {
                say_next(fmt::format("{} at {}°", name, theta));
                ratios.push_back(add_row(name, surface, theta, gold, options, report));
            }
    }
    report.table += fmt::format("geometric mean {:.2f}, least {:.2f}\n", geometric_mean(ratios),
                                *std::min_element(ratios.begin(), ratios.end()));
    return report;
}

}  // namespace

Task add_around(CLI::App& program) {
    const auto options = std::make_shared<AroundOptions>();
    CLI::App* app = program.add_subcommand("around", "isotropic light beside one azimuth");
    add_surface(*app, options->surfaces);
    add_size(*app, options->size);
    add_theta(*app, options->thetas);
    app->add_option("--rays-per-cell", options->rays_per_cell, "of a layer")->capture_default_str();
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_around(*options); }};
}

}  // namespace asperity::bench
