// SPDX-License-Identifier: Apache-2.0
// The class of surfaces: time to equal error, against the mean over the class, of several surfaces
// over one surface with all the rays, for several ways of sharing the rays out. The figure is
// error^2 x CPU time of the one surface over that of the class; making the surfaces counts.
// docs/performance.md tells what it says.
#include "averages.h"
#include "clocks.h"
#include "json_file.h"
#include "product_run.h"
#include "program.h"
#include "surfaces.h"
#include "task_options.h"
#include "workload.h"

#include <asperity/core/energy.h>
#include <asperity/gonio/noise_shares.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::bench {

namespace {

struct Options {
    std::vector<std::string> surfaces = {"gaussian-0.3", "thesis-0.2"};
    std::vector<double> thetas;  ///< none: the thesis' layers
    int size = 512, layers = 15, columns = 64;
    double jitter = 16;  ///< rays a cell of the one surface
    std::vector<double> per_cell = {4, 2, 1, 0.5, 0.25, 0.125, 0.0625};
    std::uint64_t count = 16;  ///< surfaces of a run
    int repetitions = 4, ones = 16;
    std::uint64_t reference = 400;
    std::string json_file;
};

struct Outcome {
    Measurement measurement;
    double cpu_seconds = 0;
};

/// Makes the surface and measures, on so many threads.
Outcome measured(Experiment experiment, std::uint64_t surface_seed, std::uint64_t seed,
                 int threads = 1) {
    experiment.surface.seed = surface_seed;
    experiment.run.seed = seed;
    Run run(threads);
    const double begin = cpu_seconds();
    const Heightfield surface = make_surface(experiment.surface, run);
    Outcome outcome{measure(surface, experiment, run), 0};
    outcome.cpu_seconds = cpu_seconds() - begin;
    return outcome;
}

Experiment experiment_of(const std::string& surface, const Options& options) {
    Experiment experiment;
    experiment.surface = surface_settings(surface, options.size);
    experiment.illumination.phi_deg = {kPhiDeg};
    experiment.illumination.theta_deg = options.thetas;
    experiment.illumination.layers = options.layers;
    experiment.detector.kind = DetectorKind::EqualArea;
    experiment.detector.resolution = options.columns;
    return experiment;
}

Experiment class_of(Experiment experiment, std::uint64_t surfaces, double rays_per_cell) {
    const double cells = std::pow(experiment.surface.size, 2);
    experiment.run.surfaces = surfaces;
    experiment.run.rays =
        static_cast<std::uint64_t>(rays_per_cell * cells * static_cast<double>(surfaces));
    return experiment;
}

/// Squared error of the histograms over their square, the mean over the layers.
double squared_error(const Measurement& m, const Measurement& truth) {
    double sum = 0;
    for (std::size_t k = 0; k < m.layers.size(); ++k) {
        double error = 0, square = 0;
        for (int cell = 0; cell < m.detector.cells(); ++cell) {
            const double there = truth.energy(truth.layers[k], 0, cell);
            error += std::pow(m.energy(m.layers[k], 0, cell) - there, 2);
            square += there * there;
        }
        sum += error / square;
    }
    return sum / static_cast<double>(m.layers.size());
}

/// What a measurement of a class says of its own squared error, likewise.
double told_error(const Measurement& m) {
    double sum = 0;
    for (const Layer& layer : m.layers) {
        double error = 0, square = 0;
        for (int cell = 0; cell < m.detector.cells(); ++cell) {
            error += std::pow(double{layer.stderr_energy[static_cast<std::size_t>(cell)]}, 2);
            square += std::pow(m.energy(layer, 0, cell), 2);
        }
        sum += error / square;
    }
    return sum / static_cast<double>(m.layers.size());
}

struct Row {
    double per_cell = 0;
    std::uint64_t surfaces = 1;
    double squared = 0;  ///< the reference's own error is taken off
    double told = 0, cpu_seconds = 0, share_of_rays = 0;
    double cost() const { return squared * cpu_seconds; }
};

Row measure_row(const Experiment& experiment, double per_cell, int runs, std::uint64_t first_seed,
                const Measurement& truth) {
    Row row;
    row.per_cell = per_cell;
    row.surfaces = experiment.run.surfaces;
    const double own = told_error(truth);
    std::vector<double> seconds;
    for (int k = 0; k < runs; ++k) {
        const auto seed = first_seed + static_cast<std::uint64_t>(k);
        const Outcome outcome = measured(experiment, 10000 * seed, seed);
        const Measurement& m = outcome.measurement;
        row.squared += (squared_error(m, truth) - own) / runs;
        row.told += told_error(m) / runs;
        seconds.push_back(outcome.cpu_seconds);
        if (const auto shares = shares_of_rays(m.layers)) row.share_of_rays += shares->cells / runs;
    }
    row.cpu_seconds = median(seconds);
    return row;
}

struct Table {
    std::string surface;
    Row one;
    std::vector<Row> classes;
};

Table measure_surface(const std::string& name, const Options& options) {
    const Experiment experiment = experiment_of(name, options);
    say_next(name + ", the mean over the class");
    const Measurement truth =
        measured(class_of(experiment, options.reference, 1), 1'000'000'007, 99, 0).measurement;
    Table table{name, {}, {}};
    say_next(name + ", one surface");
    Experiment one = experiment;
    one.run.jitter = options.jitter;
    table.one = measure_row(one, options.jitter, options.ones, 1, truth);
    for (const double per_cell : options.per_cell) {
        say_next(fmt::format("{}, {} rays a cell", name, per_cell));
        table.classes.push_back(measure_row(class_of(experiment, options.count, per_cell), per_cell,
                                            options.repetitions, 100, truth));
    }
    return table;
}

std::string text_of(const Table& table, const Options& options) {
    std::string text = fmt::format(
        "{}, N = {}, {}: error against the class\n{:>9}{:>12}{:>9}{:>10}{:>9}{:>12}{:>10}\n",
        table.surface, options.size,
        options.thetas.empty() ? fmt::format("{} layers", options.layers) : "given directions",
        "surfaces", "rays/cell", "CPU s", "RMS", "told", "rays' share", "figure");
    const auto row_of = [&](const Row& row, const std::string& share) {
        return fmt::format("{:>9}{:>12.4g}{:>9.2f}{:>9.2f}%{:>8.2f}%{:>12}{:>10.1f}\n",
                           row.surfaces, row.per_cell, row.cpu_seconds,
                           100 * std::sqrt(row.squared), 100 * std::sqrt(row.told), share,
                           table.one.cost() / row.cost());
    };
    text += row_of(table.one, "");
    for (const Row& row : table.classes)
        text += row_of(row, fmt::format("{:.0f} %", 100 * row.share_of_rays));
    return text;
}

nlohmann::ordered_json json_of(const Table& table, const Options& options) {
    nlohmann::ordered_json json = {{"surface", table.surface},
                                   {"size", options.size},
                                   {"layers", options.layers},
                                   {"theta_deg", options.thetas}};
    const auto add = [&](const Row& row) {
        json["rows"].push_back({{"surfaces", row.surfaces},
                                {"rays_per_cell", row.per_cell},
                                {"squared_error", row.squared},
                                {"told_squared_error", row.told},
                                {"cpu_seconds", row.cpu_seconds},
                                {"share_of_rays", row.share_of_rays},
                                {"figure", table.one.cost() / row.cost()}});
    };
    add(table.one);
    for (const Row& row : table.classes) add(row);
    return json;
}

int main_of(int argc, char** argv) {
    Options options;
    CLI::App app("Time to equal error against the class: several surfaces over one");
    add_surface(app, options.surfaces);
    add_size(app, options.size);
    app.add_option("--theta", options.thetas, "directions, in place of --layers")->delimiter(',');
    app.add_option("--layers", options.layers, "of the thesis")->capture_default_str();
    app.add_option("--columns", options.columns, "of the histogram, which has half as many rows")
        ->capture_default_str();
    app.add_option("--jitter", options.jitter, "rays a cell of the one surface")
        ->capture_default_str();
    app.add_option("--rays-per-cell", options.per_cell, "of each surface of the class")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--surfaces", options.count, "of the class")->capture_default_str();
    app.add_option("--repetitions", options.repetitions, "runs of the class to average over")
        ->capture_default_str();
    app.add_option("--ones", options.ones, "single surfaces to average over")
        ->capture_default_str();
    app.add_option("--reference", options.reference, "surfaces that stand for the whole class")
        ->capture_default_str();
    app.add_option("--json", options.json_file, "file to add all figures to");
    CLI11_PARSE(app, argc, argv);

    nlohmann::ordered_json tables;
    for (const std::string& surface : options.surfaces) {
        const Table table = measure_surface(surface, options);
        fmt::print("{}", text_of(table, options));
        std::fflush(stdout);
        tables.push_back(json_of(table, options));
    }
    fmt::print(
        "RMS: of the histogram over its own root mean square; told: by the standard errors (of one "
        "surface they know its rays alone). figure: error^2 x CPU time of one surface over it\n");
    if (!options.json_file.empty()) add_to_json(options.json_file, "class", tables);
    return 0;
}

}  // namespace

}  // namespace asperity::bench

int main(int argc, char** argv) {
    return asperity::bench::guarded_main("class_bench",
                                         [&] { return asperity::bench::main_of(argc, argv); });
}
