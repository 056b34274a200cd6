// SPDX-License-Identifier: Apache-2.0
// Does a path cost more on a larger surface, and how much memory does one take?
#include "averages.h"
#include "clocks.h"
#include "product_run.h"
#include "product_tasks.h"
#include "rival.h"
#include "task_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

namespace asperity::bench {

namespace {

struct GrowthOptions {
    std::string surface = "gaussian-0.3";
    std::vector<int> sizes = {512, 4096, 16384};
    double theta_deg = 45;
    std::uint64_t paths = 0;
    int repetitions = 5;
};

/// Paths when none are asked for: one a cell within these limits.
constexpr std::uint64_t kLeastPaths = 1 << 18, kMostPaths = 1 << 28;

/// Forgets the largest size this process has had.
void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

/// Largest size of this process since then [MiB].
double peak_mebibytes() {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
        double kibibytes = 0;
        if (word == "VmHWM:" && file >> kibibytes) return kibibytes / 1024;
    }
    return 0;
}

/// A surface of one size on its way through the benchmark.
struct Entry {
    Heightfield surface;
    std::unique_ptr<Rival> tracer;
    Workload workload;
    double peak_making = 0, peak_tracing = 0;
    std::vector<double> seconds_per_path;

    void repeat() {
        ++workload.seed;
        const double begin = cpu_seconds();
        const Tally tally = tracer->run(workload);
        seconds_per_path.push_back((cpu_seconds() - begin) / static_cast<double>(tally.paths()));
    }
};

std::unique_ptr<Entry> make_ready(const GrowthOptions& options, int size) {
    auto entry = std::make_unique<Entry>();
    forget_peak_memory();
    entry->surface = make_bench_surface(options.surface, size);
    entry->peak_making = peak_mebibytes();
    forget_peak_memory();
    entry->tracer = make_own_rival(entry->surface, Run().threads());
    entry->workload.surface = &entry->surface;
    entry->workload.theta_deg = options.theta_deg;
    entry->workload.own_paths =
        options.paths > 0 ? options.paths
                          : std::clamp(entry->surface.cell_count(), kLeastPaths, kMostPaths);
    entry->repeat();
    entry->peak_tracing = peak_mebibytes();
    return entry;
}

Report report(const GrowthOptions& options, const std::vector<std::unique_ptr<Entry>>& entries) {
    Report report;
    report.table = fmt::format(
        "Growth: {} at {}°, one thread; cost per path relative to the first\n"
        "{:>6}{:>12}{:>12}{:>8}{:>10}{:>14}{:>13}{:>14}\n",
        options.surface, options.theta_deg, "N", "paths", "Mpaths/s", "cost", "build s",
        "bytes/sample", "peak making", "peak tracing");
    const double first = median(entries.front()->seconds_per_path);
    for (const auto& entry : entries) {
        const double cost = median(entry->seconds_per_path);
        const auto samples = static_cast<double>(entry->surface.heights.size());
        const double bytes = static_cast<double>(entry->tracer->memory_bytes()) / samples;
        report.table += fmt::format(
            "{:>6}{:>12}{:>12.3f}{:>8.2f}{:>10.3f}{:>14.2f}{:>13.0f}{:>14.0f}\n", entry->surface.nx,
            entry->workload.own_paths, 1e-6 / cost, cost / first, entry->tracer->build_seconds(),
            bytes, entry->peak_making, entry->peak_tracing);
        report.figures.push_back({{"surface", options.surface},
                                  {"theta_deg", options.theta_deg},
                                  {"size", entry->surface.nx},
                                  {"paths", entry->workload.own_paths},
                                  {"paths_per_second", 1 / cost},
                                  {"relative_cost", cost / first},
                                  {"build_seconds", entry->tracer->build_seconds()},
                                  {"bytes_per_sample", bytes},
                                  {"peak_mebibytes_making", entry->peak_making},
                                  {"peak_mebibytes_tracing", entry->peak_tracing}});
    }
    report.table +=
        "bytes/sample: beside the heights, which take 4. peak: of the whole process [MiB], "
        "smaller\n"
        "surfaces included, while the surface was made and while it was traced.\n";
    return report;
}

Report run_growth(const GrowthOptions& options) {
    std::vector<std::unique_ptr<Entry>> entries;
    for (const int size : options.sizes) {
        say_next(fmt::format("N = {}", size));
        entries.push_back(make_ready(options, size));
    }
    for (int repetition = 1; repetition < options.repetitions; ++repetition) {
        for (const auto& entry : entries) entry->repeat();
    }
    return report(options, entries);
}

}  // namespace

Task add_growth(CLI::App& program) {
    const auto options = std::make_shared<GrowthOptions>();
    CLI::App* app = program.add_subcommand("growth", "cost per path and memory by size");
    add_surface(*app, options->surface);
    app->add_option("--size", options->sizes, "samples on a side, smallest first")
        ->check(CLI::Range(2, kMaxSurfaceSide))
        ->delimiter(',')
        ->capture_default_str();
    add_theta(*app, options->theta_deg);
    app->add_option("--paths", options->paths, "default: one a cell, at least 2^18, at most 2^28");
    add_repetitions(*app, options->repetitions);
    return {app, [options] { return run_growth(*options); }};
}

}  // namespace asperity::bench
