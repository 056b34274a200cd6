// SPDX-License-Identifier: Apache-2.0
// Speed of our tracer beside Embree's and the thesis' marching: same surfaces and incidence, same
// run. docs/performance.md says what is measured and why this way.
#include "json_file.h"
#include "program.h"
#include "report.h"
#include "rival.h"
#include "surfaces.h"
#include "task_options.h"

#include <asperity/core/run.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>
#include <hwy/targets.h>
#include <pmmintrin.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <map>

namespace asperity::bench {

namespace {

/// Rows of docs/performance.md: all surfaces at this size, the smooth ones at larger sizes too.
constexpr int kSizeOfAll = 512;
/// Paths per row that launch by themselves: per cell, as in the demo, and at most.
constexpr std::uint64_t kOwnPerCell = 8, kOwnPaths = 1 << 26;

struct Options {
    std::vector<std::string> surfaces;
    std::vector<int> sizes = {512, 4096};
    std::vector<double> thetas = {0, 45, 80};
    int paths = 1 << 19;
    std::uint64_t own_paths = 0;
    int repetitions = 5;
    int bounces = 16;
    EmbreeModes modes = EmbreeModes::Usual;
    std::int64_t vectors = 0;  ///< of Highway's targets; 0: the widest
    bool check = false, quiet = false;
    std::string json_file;
};

std::vector<std::string> surfaces_of(const Options& options, int size) {
    if (!options.surfaces.empty()) return options.surfaces;
    std::vector<std::string> names = surface_names();
    if (size > kSizeOfAll) {
        std::erase_if(names, [](const std::string& name) { return !is_gaussian(name); });
    }
    return names;
}

std::vector<Row> race_on(const Heightfield& surface, const Options& options, int threads) {
    std::vector<std::unique_ptr<Rival>> rivals;
    if (!options.check) rivals.push_back(make_own_rival(surface, threads));
    rivals.push_back(make_plain_rival(surface, threads));
    for (const bool tuned : {false, true}) rivals.push_back(make_thesis_rival(surface, tuned));
    auto embree = make_embree_rivals(surface, options.modes);
    std::move(embree.begin(), embree.end(), std::back_inserter(rivals));

    RaceSettings settings;
    settings.thetas_deg = options.thetas;
    settings.points = options.paths;
    settings.own_paths =
        options.own_paths > 0
            ? options.own_paths
            : std::max<std::uint64_t>(static_cast<std::uint64_t>(options.paths),
                                      std::min(kOwnPerCell * surface.cell_count(), kOwnPaths));
    settings.repetitions = options.repetitions;
    settings.bounces = options.bounces;
    return race(surface, rivals, settings);
}

std::vector<Row> race_all(const Options& options) {
    std::vector<Row> all;
    for (const int size : options.sizes) {
        for (const std::string& name : surfaces_of(options, size)) {
            if (!options.quiet) say_next(fmt::format("{}, N = {}", name, size));
            Run run;
            const Heightfield surface = make_surface(surface_settings(name, size), run);
            for (Row& row : race_on(surface, options, run.threads())) {
                row.surface = name;
                all.push_back(std::move(row));
            }
        }
    }
    return all;
}

/// Says which rows disagree; true if none does.
bool all_agree(const std::vector<Row>& rows) {
    // Same points: far above what the roundings of single precision do, far below a mistake. Own
    // points: twice the difference that chance makes.
    constexpr double kTightLimit = 0.25, kLooseLimit = 2;
    bool agree = true;
    for (const Row& row : rows) {
        if (row.tight_disagreement() < kTightLimit && !(row.loose_disagreement() >= kLooseLimit)) {
            continue;
        }
        fmt::print(stderr, "trace_bench: error: {}, N = {}, {}°: the rivals disagree\n",
                   row.surface, row.size, row.theta_deg);
        agree = false;
    }
    return agree;
}

/// Refuses numbers that are not multiples of `unit`.
struct MultipleOf : CLI::Validator {
    explicit MultipleOf(int unit) : Validator("MULTIPLE OF " + std::to_string(unit)) {
        func_ = [unit](const std::string& text) {
            return std::stol(text) % unit == 0
                       ? std::string()
                       : text + " is not a multiple of " + std::to_string(unit);
        };
    }
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("--surface", options.surfaces,
                   "which ones; default: all at N = 512, the Gaussian ones above")
        ->check(CLI::IsMember(surface_names()))
        ->delimiter(',');
    app.add_option("--size", options.sizes, "samples on a side of the surfaces, multiples of 64")
        ->check(CLI::Range(kBlock, kMaxSurfaceSide))
        ->check(MultipleOf(kBlock))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--theta", options.thetas, "polar angles of incidence [degrees]")
        ->check(CLI::Range(0.0, 89.0))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--paths", options.paths, "competitors' paths per row, a multiple of 4096")
        ->check(CLI::Range(kBlock * kBlock, 1 << 30))
        ->check(MultipleOf(kBlock * kBlock))
        ->capture_default_str();
    app.add_option(
        "--own-paths", options.own_paths,
        "our paths per row; default: 8 a cell as in the demo, at least --paths, at most 2^26");
    add_repetitions(app, options.repetitions);
    app.add_option("--bounces", options.bounces, "reflections a path may make")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    const std::map<std::string, EmbreeModes> modes = {{"none", EmbreeModes::None},
                                                      {"grid", EmbreeModes::Grid},
                                                      {"usual", EmbreeModes::Usual},
                                                      {"all", EmbreeModes::All}};
    app.add_option("--modes", options.modes, "of Embree: none, grid (little memory), usual, all")
        ->transform(CLI::CheckedTransformer(modes));
    const std::map<std::string, std::int64_t> vectors = {
        {"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}};
    app.add_option("--vectors", options.vectors, "of ours: at most avx512, avx2 or sse4")
        ->transform(CLI::CheckedTransformer(vectors));
    app.add_flag("--check", options.check,
                 "leave the product out: only the rivals that follow the same points");
    app.add_option("--json", options.json_file, "file to add all figures to");
    app.add_flag("--quiet", options.quiet, "no progress");
}

int main_of(int argc, char** argv) {
    Options options;
    CLI::App app("Paths per second of our tracer beside Embree's, on the same surfaces");
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);

    // As Embree's manual asks; the same for us.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);

    // Wider sets have lower bits in Highway's list
    if (options.vectors != 0) hwy::DisableTargets(options.vectors - 1);

    const std::vector<Row> rows = race_all(options);
    fmt::print("{}", table(rows));
    if (!options.json_file.empty()) add_to_json(options.json_file, "trace", json(rows));
    return options.modes == EmbreeModes::None || all_agree(rows) ? 0 : 1;
}

}  // namespace

}  // namespace asperity::bench

int main(int argc, char** argv) {
    return asperity::bench::guarded_main("trace_bench",
                                         [&] { return asperity::bench::main_of(argc, argv); });
}
