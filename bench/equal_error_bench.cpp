// SPDX-License-Identifier: Apache-2.0
// Time to equal error: how much longer independent random launch points must be traced until their
// histogram is as good. The figure is error^2 x CPU time of the random launch over that of a
// pattern, all through measure(). docs/performance.md says why this way.
#include "averages.h"
#include "json_file.h"
#include "product_run.h"
#include "program.h"
#include "task_options.h"

#include <asperity/core/energy.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity::bench {

namespace {

/// The histogram whose error counts: equal cells of projected solid angle. A detector of as many
/// columns has twice the rows; they are taken in pairs.
constexpr std::size_t kColumns = 128, kRows = 32, kCells = kColumns * kRows;
using Histogram = std::vector<double>;

struct Options {
    std::vector<std::string> surfaces = {"gaussian-0.1", "gaussian-0.3", "thesis-0.2"};
    std::vector<double> thetas = {45, 80};
    int size = 512;
    std::vector<std::uint64_t> rays = {1 << 20, 1 << 24};
    std::vector<int> seeds = {8, 3};
    int batches = RunSettings{}.batches;
    bool isotropic = false;
    std::uint64_t reference_rays = 200'000'000;
    std::string json_file;
};

struct Pattern {
    const char* name;
    LaunchPattern launch;
};
/// The first one is what the others are compared with.
constexpr Pattern kPatterns[] = {{"random", LaunchPattern::Random},
                                 {"stratified", LaunchPattern::Stratified},
                                 {"low discrepancy", LaunchPattern::LowDiscrepancy}};
constexpr std::size_t kPatternCount = std::size(kPatterns);

/// What all runs of one row have in common.
struct Setting {
    const Heightfield& surface;
    double theta_deg;
    int batches;
    bool isotropic;
};

Experiment experiment_of(const Setting& setting, LaunchPattern launch, std::uint64_t rays,
                         std::uint64_t seed) {
    Experiment experiment = bench_experiment(setting.theta_deg, rays);
    experiment.detector.resolution = static_cast<int>(kColumns);
    experiment.detector.orders = 1;
    if (setting.isotropic) {
        experiment.illumination.phi_deg = {0};
        experiment.illumination.isotropic = true;
    }
    experiment.run.launch = launch;
    experiment.run.batches = setting.batches;
    experiment.run.seed = seed;
    return experiment;
}

/// Share of the light in each cell.
Histogram histogram(const Measurement& m) {
    const Layer& layer = m.layers.front();
    Histogram result(kCells);
    for (std::size_t k = 0; k < layer.energy.size(); ++k) {
        const std::size_t row = k / kColumns / 2, column = k % kColumns;
        result[row * kColumns + column] += energy_fraction(layer.energy[k], layer.rays);
    }
    return result;
}

double mean_square_difference(const Histogram& a, const Histogram& b) {
    double sum = 0;
    for (std::size_t k = 0; k < kCells; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum / static_cast<double>(kCells);
}

/// The truth, nearly: the mean of two independent halves, whose difference tells its own error.
struct Reference {
    Histogram mean;
    double variance = 0;
};

Reference reference_of(const Setting& setting, std::uint64_t rays) {
    constexpr std::uint64_t kFirstSeed = 1'000'001;  // none of the runs under test has it
    const auto half = [&](std::uint64_t seed) {
        const Experiment experiment =
            experiment_of(setting, LaunchPattern::LowDiscrepancy, rays / 2, seed);
        return histogram(timed_measure(setting.surface, experiment, 0).measurement);
    };
    const Histogram a = half(kFirstSeed), b = half(kFirstSeed + 1);
    Reference reference{Histogram(kCells), mean_square_difference(a, b) / 4};
    for (std::size_t k = 0; k < kCells; ++k) reference.mean[k] = (a[k] + b[k]) / 2;
    return reference;
}

/// One pattern on one row: mean over the seeds.
struct Outcome {
    double variance = 0;     ///< mean square error of a cell, the reference's own taken off
    double cpu_seconds = 0;  ///< of tracing
    double cost() const { return variance * cpu_seconds; }
};

struct Row {
    std::string surface;
    double theta_deg = 0;
    std::uint64_t rays = 0;
    double reference_variance = 0;
    std::array<Outcome, kPatternCount> outcomes;

    double figure(std::size_t pattern) const {
        return outcomes[0].cost() / outcomes[pattern].cost();
    }
    /// False when what is left after taking off the reference's own error is little more than it.
    bool reference_is_good(std::size_t pattern) const {
        return outcomes[pattern].variance > 2 * reference_variance;
    }
};

Row measure_row(const Setting& setting, const Reference& reference, std::uint64_t rays, int seeds) {
    Row row;
    row.theta_deg = setting.theta_deg;
    row.rays = rays;
    row.reference_variance = reference.variance;
    std::array<std::vector<double>, kPatternCount> seconds;
    for (int seed = 1; seed <= seeds; ++seed) {
        for (std::size_t p = 0; p < kPatternCount; ++p) {
            const Experiment experiment =
                experiment_of(setting, kPatterns[p].launch, rays, static_cast<std::uint64_t>(seed));
            const TimedRun run = timed_measure(setting.surface, experiment, 1);
            seconds[p].push_back(run.cpu_seconds);
            row.outcomes[p].variance +=
                (mean_square_difference(histogram(run.measurement), reference.mean) -
                 reference.variance) /
                seeds;
        }
    }
    const double setup = setup_cpu_seconds(
        setting.surface, experiment_of(setting, LaunchPattern::LowDiscrepancy, rays, 1));
    for (std::size_t p = 0; p < kPatternCount; ++p) {
        row.outcomes[p].cpu_seconds = median(seconds[p]) - setup;
    }
    return row;
}

std::vector<Row> measure_all(const Options& options) {
    std::vector<Row> rows;
    for (const std::string& name : options.surfaces) {
        const Heightfield surface = make_bench_surface(name, options.size);
        for (const double theta : options.thetas) {
            say_next(fmt::format("{} at {}°", name, theta));
            const Setting setting{surface, theta, options.batches, options.isotropic};
            const Reference reference = reference_of(setting, options.reference_rays);
            for (std::size_t k = 0; k < options.rays.size(); ++k) {
                rows.push_back(measure_row(setting, reference, options.rays[k],
                                           options.seeds[std::min(k, options.seeds.size() - 1)]));
                rows.back().surface = name;
            }
        }
    }
    return rows;
}

/// Geometric mean of a pattern's figures over all rows of `rays`.
double mean_figure(const std::vector<Row>& rows, std::size_t pattern, std::uint64_t rays) {
    std::vector<double> figures;
    for (const Row& row : rows) {
        if (row.rays == rays) figures.push_back(row.figure(pattern));
    }
    return geometric_mean(figures);
}

std::string table(const std::vector<Row>& rows, const Options& options) {
    std::string text = fmt::format(
        "Time to equal error of a {} x {} histogram over that of random launch, {}, N = {}\n"
        "{:<14}{:>6}{:>12}{:>13}{:>13}{:>12}{:>17}\n",
        kColumns, kRows, options.isotropic ? "isotropic light" : "light of one azimuth",
        options.size, "surface", "theta", "rays", "random RMS", "lowdisc. RMS", kPatterns[1].name,
        kPatterns[2].name);
    for (const Row& row : rows) {
        text +=
            fmt::format("{:<14}{:>6.0f}{:>12}{:>13.3e}{:>13.3e}{:>12.2f}{:>16.2f}{}\n", row.surface,
                        row.theta_deg, row.rays, std::sqrt(row.outcomes[0].variance),
                        std::sqrt(row.outcomes[2].variance), row.figure(1), row.figure(2),
                        row.reference_is_good(2) ? " " : "?");
    }
    for (const std::uint64_t rays : options.rays) {
        text +=
            fmt::format("{} rays, geometric means: {} {:.2f}, {} {:.2f}\n", rays, kPatterns[1].name,
                        mean_figure(rows, 1, rays), kPatterns[2].name, mean_figure(rows, 2, rays));
    }
    return text + "RMS: error of a cell, as a share of the light. ?: take more --reference-rays.\n";
}

nlohmann::ordered_json json(const std::vector<Row>& rows, const Options& options) {
    nlohmann::ordered_json result;
    for (const std::uint64_t rays : options.rays) {
        nlohmann::ordered_json mean = {{"rays", rays}};
        for (std::size_t p = 1; p < kPatternCount; ++p) {
            mean[kPatterns[p].name] = mean_figure(rows, p, rays);
        }
        result["means"].push_back(std::move(mean));
    }
    for (const Row& row : rows) {
        nlohmann::ordered_json entry = {{"surface", row.surface},
                                        {"size", options.size},
                                        {"theta_deg", row.theta_deg},
                                        {"rays", row.rays},
                                        {"batches", options.batches},
                                        {"reference_rays", options.reference_rays},
                                        {"reference_rms", std::sqrt(row.reference_variance)}};
        for (std::size_t p = 0; p < kPatternCount; ++p) {
            entry["patterns"].push_back({{"name", kPatterns[p].name},
                                         {"mean_square_error", row.outcomes[p].variance},
                                         {"cpu_seconds", row.outcomes[p].cpu_seconds},
                                         {"figure", row.figure(p)}});
        }
        result["rows"].push_back(std::move(entry));
    }
    return result;
}

int main_of(int argc, char** argv) {
    Options options;
    CLI::App app("Time to equal error of the launch patterns over random launch");
    add_surface(app, options.surfaces);
    add_theta(app, options.thetas);
    add_size(app, options.size);
    app.add_option("--rays", options.rays, "of a run")->delimiter(',')->capture_default_str();
    app.add_option("--seeds", options.seeds, "runs to average over, for each of --rays")
        ->check(CLI::Range(1, 1'000'000))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--batches", options.batches, "independent ones of a run, at least")
        ->capture_default_str();
    app.add_flag("--isotropic", options.isotropic,
                 "light from all around: random launch gives each ray an azimuth of its own");
    app.add_option("--reference-rays", options.reference_rays)->capture_default_str();
    app.add_option("--json", options.json_file, "file to add all figures to");
    CLI11_PARSE(app, argc, argv);

    const std::vector<Row> rows = measure_all(options);
    fmt::print("{}", table(rows, options));
    if (!options.json_file.empty()) {
        add_to_json(options.json_file, options.isotropic ? "equal_error_isotropic" : "equal_error",
                    json(rows, options));
    }
    return 0;
}

}  // namespace

}  // namespace asperity::bench

int main(int argc, char** argv) {
    return asperity::bench::guarded_main("equal_error_bench",
                                         [&] { return asperity::bench::main_of(argc, argv); });
}
