// SPDX-License-Identifier: Apache-2.0
// Where does the time of a whole run go? The stages of `asperity simulate -o FILE` with default
// settings, on the wall clock, with all threads.
#include "averages.h"
#include "clocks.h"
#include "product_run.h"
#include "product_tasks.h"
#include "surfaces.h"
#include "task_options.h"

#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/surface/statistics.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

namespace asperity::bench {

namespace {

struct StagesOptions {
    std::vector<std::string> surfaces = {"thesis-0.2", "gaussian-0.3"};
    int size = SurfaceSettings{}.size;
    double jitter = RunSettings{}.jitter;
    int threads = 0;
    int repetitions = 5;
};

enum Stage : std::size_t { kSurface, kSetup, kTracing, kBinning, kStatistics, kSaving, kStages };
constexpr const char* kNames[kStages] = {"surface", "set-up",     "tracing",
                                         "binning", "statistics", "saving"};
using Seconds = std::array<double, kStages>;

/// One run, stage by stage. Binning and merging have no clock of their own: they are the time that
/// tracing the same rays into one small detector and one order saves.
Seconds run_once(const Experiment& experiment, int threads, const std::string& path) {
    Seconds seconds{};
    double last = wall_seconds();
    const auto lap = [&last] {
        const double now = wall_seconds(), passed = now - last;
        last = now;
        return passed;
    };
    Run run(threads);
    const Heightfield surface = io::load_surface(experiment.surface, run);
    seconds[kSurface] = lap();
    statistics(surface, run.threads());
    seconds[kStatistics] = lap();

    const Measurement m = measure(surface, experiment, run);
    const double measuring = lap();
    io::save_measurement(m, path);
    seconds[kSaving] = lap();

    Experiment coarse = experiment;
    coarse.detector.resolution = 4;
    coarse.detector.orders = 1;
    const Measurement few_cells = measure(surface, coarse, run);
    seconds[kBinning] = std::max(0.0, m.trace_seconds - few_cells.trace_seconds);
    seconds[kTracing] = m.trace_seconds - seconds[kBinning];
    seconds[kSetup] = std::max(0.0, measuring - m.trace_seconds - seconds[kStatistics]);
    return seconds;
}

Report run_stages(const StagesOptions& options) {
    Report report;
    report.table = fmt::format(
        "Stages of a run of 15 layers, N = {}, {} rays a cell: milliseconds (share)\n{:<14}",
        options.size, options.jitter, "surface");
    for (const char* name : kNames) report.table += fmt::format("{:>17}", name);
    report.table += fmt::format("{:>10}\n", "all");
    const std::string path =
        (std::filesystem::temp_directory_path() / "asperity_stages.asperity").string();
    for (const std::string& name : options.surfaces) {
        say_next(name);
        Experiment experiment;
        experiment.surface = surface_settings(name, options.size);
        experiment.run.jitter = options.jitter;
        std::array<std::vector<double>, kStages> all;
        for (int repetition = 0; repetition < options.repetitions; ++repetition) {
            std::filesystem::remove(path);
            const Seconds seconds = run_once(experiment, options.threads, path);
            for (std::size_t s = 0; s < kStages; ++s) all[s].push_back(seconds[s]);
        }
        std::filesystem::remove(path);

        Seconds middle{};
        double total = 0;
        for (std::size_t s = 0; s < kStages; ++s) total += middle[s] = median(all[s]);
        nlohmann::ordered_json figures = {{"surface", name}, {"size", options.size}};
        report.table += fmt::format("{:<14}", name);
        for (std::size_t s = 0; s < kStages; ++s) {
            report.table +=
                fmt::format("{:>9.1f} ({:>4.1f}%)", 1e3 * middle[s], 100 * middle[s] / total);
            figures["seconds"][kNames[s]] = middle[s];
        }
        report.table += fmt::format("{:>10.1f}\n", 1e3 * total);
        figures["share_of_tracing"] = middle[kTracing] / total;
        report.figures.push_back(std::move(figures));
    }
    return report;
}

}  // namespace

Task add_stages(CLI::App& program) {
    const auto options = std::make_shared<StagesOptions>();
    CLI::App* app = program.add_subcommand("stages", "where the time of a whole run goes");
    add_surface(*app, options->surfaces);
    add_size(*app, options->size);
    app->add_option("--jitter", options->jitter, "launch points per cell")->capture_default_str();
    app->add_option("--threads", options->threads, "0: all");
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_stages(*options); }};
}

}  // namespace asperity::bench
