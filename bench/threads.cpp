// SPDX-License-Identifier: Apache-2.0
// How much faster are two threads than one?
#include "averages.h"
#include "product_run.h"
#include "product_tasks.h"
#include "task_options.h"

#include <fmt/format.h>

#include <memory>

namespace asperity::bench {

namespace {

struct ThreadsOptions {
    std::vector<std::string> surfaces = {"gaussian-0.3", "thesis-0.2"};
    int size = 512;
    double theta_deg = 45;
    int threads = 2;
    double seconds = 1;
    int repetitions = 5;
};

/// Wall-clock seconds of the repetitions of one number of threads.
struct Times {
    std::vector<double> tracing, whole;

    void add(const TimedRun& run) {
        tracing.push_back(run.measurement.trace_seconds);
        whole.push_back(run.wall_seconds);
    }
};

Report run_threads(const ThreadsOptions& options) {
    Report report;
    report.table = fmt::format(
        "Threads: wall-clock seconds of {} beside one, N = {}, {}°\n"
        "{:<14}{:>12}{:>10}{:>10}{:>9}{:>12}{:>12}{:>9}\n",
        options.threads, options.size, options.theta_deg, "surface", "rays", "trace 1",
        fmt::format("trace {}", options.threads), "ratio", "measure 1",
        fmt::format("measure {}", options.threads), "ratio");
    for (const std::string& name : options.surfaces) {
        say_next(name);
        const Heightfield surface = make_bench_surface(name, options.size);
        Experiment experiment = bench_experiment(options.theta_deg, 0);
        experiment.run.rays = rays_for_seconds(surface, experiment, options.seconds);
        Times one, many;
        for (int repetition = 0; repetition < options.repetitions; ++repetition) {
            one.add(timed_measure(surface, experiment, 1));
            many.add(timed_measure(surface, experiment, options.threads));
        }
        const double trace_ratio = median(one.tracing) / median(many.tracing);
        const double whole_ratio = median(one.whole) / median(many.whole);
        report.table +=
            fmt::format("{:<14}{:>12}{:>10.3f}{:>10.3f}{:>9.3f}{:>12.3f}{:>12.3f}{:>9.3f}\n", name,
                        experiment.run.rays, median(one.tracing), median(many.tracing), trace_ratio,
                        median(one.whole), median(many.whole), whole_ratio);
        report.figures.push_back({{"surface", name},
                                  {"size", options.size},
                                  {"theta_deg", options.theta_deg},
                                  {"threads", options.threads},
                                  {"rays", experiment.run.rays},
                                  {"trace_seconds_one", median(one.tracing)},
                                  {"trace_seconds_many", median(many.tracing)},
                                  {"trace_ratio", trace_ratio},
                                  {"measure_seconds_one", median(one.whole)},
                                  {"measure_seconds_many", median(many.whole)},
                                  {"measure_ratio", whole_ratio}});
    }
    return report;
}

}  // namespace

Task add_threads(CLI::App& program) {
    const auto options = std::make_shared<ThreadsOptions>();
    CLI::App* app = program.add_subcommand("threads", "several threads beside one");
    add_surface(*app, options->surfaces);
    add_size(*app, options->size);
    add_theta(*app, options->theta_deg);
    app->add_option("--threads", options->threads)->check(CLI::Range(2, 1024));
    app->add_option("--seconds", options->seconds, "one thread's work in a repetition, about")
        ->capture_default_str();
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_threads(*options); }};
}

}  // namespace asperity::bench
