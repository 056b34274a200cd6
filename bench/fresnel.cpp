// SPDX-License-Identifier: Apache-2.0
// What do exact reflectances of a metal in three channels, kept apart by reflections, cost over
// perfect mirrors?
#include "averages.h"
#include "product_run.h"
#include "product_tasks.h"
#include "surfaces.h"

#include <fmt/format.h>

#include <memory>

namespace asperity::bench {

namespace {

struct Options {
    std::vector<std::string> surfaces = {"gaussian-0.3", "thesis-0.2", "thesis-1"};
    int size = 512;
    std::vector<double> thetas = {0, 45, 80};
    double seconds = 0.5;
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

Report run(const Options& options) {
    Report report;
    report.table = fmt::format(
        "Fresnel: gold in RGB with 4 orders over perfect mirrors with 1, N = {}, one thread\n"
        "{:<14}{:>6}{:>12}{:>12}{:>12}{:>8}\n",
        options.size, "surface", "theta", "rays", "mirrors M/s", "gold M/s", "cost");
    for (const std::string& name : options.surfaces) {
        const Heightfield surface = make_bench_surface(name, options.size);
        for (const double theta : options.thetas) {
            Experiment plain = mirrors(theta), metal = gold(theta);
            plain.run.rays = rays_for_seconds(surface, plain, options.seconds);
            metal.run.rays = plain.run.rays;
            const double plain_setup = setup_cpu_seconds(surface, plain);
            const double metal_setup = setup_cpu_seconds(surface, metal);
            std::vector<double> plain_seconds, metal_seconds;
            for (int repetition = 0; repetition < options.repetitions; ++repetition) {
                plain_seconds.push_back(timed_measure(surface, plain, 1).cpu_seconds);
                metal_seconds.push_back(timed_measure(surface, metal, 1).cpu_seconds);
            }
            const auto rays = static_cast<double>(plain.run.rays);
            const double plain_cost = (median(plain_seconds) - plain_setup) / rays;
            const double metal_cost = (median(metal_seconds) - metal_setup) / rays;
            report.table += fmt::format("{:<14}{:>6.0f}{:>12}{:>12.3f}{:>12.3f}{:>8.3f}\n", name,
                                        theta, plain.run.rays, 1e-6 / plain_cost, 1e-6 / metal_cost,
                                        metal_cost / plain_cost);
            report.figures.push_back({{"surface", name},
                                      {"size", options.size},
                                      {"theta_deg", theta},
                                      {"rays", plain.run.rays},
                                      {"mirrors_paths_per_second", 1 / plain_cost},
                                      {"gold_paths_per_second", 1 / metal_cost},
                                      {"relative_cost", metal_cost / plain_cost}});
        }
    }
    return report;
}

}  // namespace

Task add_fresnel(CLI::App& program) {
    const auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand("fresnel", "a metal beside perfect mirrors");
    app->add_option("--surface", options->surfaces)
        ->check(CLI::IsMember(surface_names()))
        ->delimiter(',')
        ->capture_default_str();
    app->add_option("--size", options->size, "samples on a side")
        ->check(CLI::Range(2, kMaxSurfaceSide))
        ->capture_default_str();
    app->add_option("--theta", options->thetas, "of incidence [degrees]")
        ->delimiter(',')
        ->capture_default_str();
    app->add_option("--seconds", options->seconds, "the mirrors' work in a repetition, about")
        ->capture_default_str();
    app->add_option("--repetitions", options->repetitions)
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    return {app, [options] { return bench::run(*options); }};
}

}  // namespace asperity::bench
