// SPDX-License-Identifier: Apache-2.0
// Speed of our tracer beside Embree's: same surfaces, same launch points in the same order, same
// run. docs/performance.md says what is measured and why this way.
#include "report.h"
#include "rival.h"
#include "workload.h"

#include <asperity/core/run.h>
#include <asperity/surface/make_surface.h>

#include <fmt/format.h>
#include <pmmintrin.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>

namespace asperity::bench {

namespace {

struct Options {
    std::vector<int> sizes = {512, 4096};
    std::vector<double> thetas = {0, 45, 80};
    int paths = 1 << 20;
    int repetitions = 5;
    int bounces = 16;
    bool as_json = false, quiet = false;
};

struct NamedSurface {
    std::string name;
    SurfaceSettings settings;
};

std::vector<NamedSurface> surfaces(int size) {
    NamedSurface thesis{"thesis 0.2", {}}, gaussian{"gaussian 0.424", {}};
    thesis.settings.kind = SurfaceKind::Thesis;
    thesis.settings.roughness = 0.2;
    gaussian.settings.kind = SurfaceKind::Gaussian;
    gaussian.settings.alpha_x = gaussian.settings.alpha_y = 0.424;
    gaussian.settings.correlation_x = gaussian.settings.correlation_y = 8;
    thesis.settings.size = gaussian.settings.size = size;
    return {thesis, gaussian};
}

/// Seconds this thread has spent computing.
double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Lets the rivals run in turn, `repetitions` times, so that none has the quiet hour for itself.
Row race(const std::vector<std::unique_ptr<Rival>>& rivals, const Workload& workload,
         int repetitions) {
    Row row;
    row.theta_deg = workload.theta_deg;
    std::vector<std::vector<double>> seconds(rivals.size());
    row.measured.resize(rivals.size());
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        for (std::size_t r = 0; r < rivals.size(); ++r) {
            const double begin = cpu_seconds();
            row.measured[r].tally = rivals[r]->follow(workload);
            seconds[r].push_back(cpu_seconds() - begin);
        }
    }
    for (std::size_t r = 0; r < rivals.size(); ++r) {
        row.measured[r].rival = rivals[r]->name();
        row.measured[r].seconds = median(seconds[r]);
        row.measured[r].memory_bytes = rivals[r]->memory_bytes();
        row.measured[r].build_seconds = rivals[r]->build_seconds();
    }
    return row;
}

std::vector<Row> race_all(const Options& options) {
    std::vector<Row> rows;
    for (const int size : options.sizes) {
        for (const NamedSurface& named : surfaces(size)) {
            Run run;
            const Heightfield surface = make_surface(named.settings, run);
            auto rivals = make_embree_rivals(surface);
            rivals.insert(rivals.begin(), make_own_rival(surface, run.threads()));
            Workload workload;
            workload.surface = &surface;
            workload.launch = blocked_launch(surface, options.paths, 1);
            workload.bounces = options.bounces;
            for (const double theta : options.thetas) {
                if (!options.quiet) {
                    fmt::print(stderr, "{} at {}°, N = {} ...\n", named.name, theta, size);
                }
                workload.theta_deg = theta;
                workload.direction = incident_direction(theta);
                rows.push_back(race(rivals, workload, options.repetitions));
                rows.back().surface = named.name;
                rows.back().size = size;
            }
        }
    }
    return rows;
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

int main_of(int argc, char** argv) {
    Options options;
    CLI::App app("Paths per second of our tracer beside Embree's, on the same surfaces");
    app.add_option("--size", options.sizes, "samples on a side of the surfaces, multiples of 64")
        ->check(CLI::Range(kBlock, kMaxSurfaceSide))
        ->check(MultipleOf(kBlock))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--theta", options.thetas, "polar angles of incidence [degrees]")
        ->check(CLI::Range(0.0, 89.0))
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--paths", options.paths, "paths per row, a multiple of 4096")
        ->check(CLI::Range(kBlock * kBlock, 1 << 30))
        ->check(MultipleOf(kBlock * kBlock))
        ->capture_default_str();
    app.add_option("--repetitions", options.repetitions, "of which the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--bounces", options.bounces, "reflections a path may make")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_flag("--json", options.as_json, "all figures as JSON");
    app.add_flag("--quiet", options.quiet, "no progress");
    CLI11_PARSE(app, argc, argv);

    // As Embree's manual asks; the same for us.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);

    const std::vector<Row> rows = race_all(options);
    fmt::print("{}", options.as_json ? json(rows).dump(2) + "\n" : table(rows));
    // Far above what the roundings of single precision do, far below a mistake.
    constexpr double kLimit = 0.25;
    for (const Row& row : rows) {
        if (row.disagreement() >= kLimit) {
            fmt::print(stderr, "trace_bench: error: {} at {}°: the rivals disagree\n", row.surface,
                       row.theta_deg);
            return 1;
        }
    }
    return 0;
}

}  // namespace

}  // namespace asperity::bench

int main(int argc, char** argv) {
    try {
        return asperity::bench::main_of(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "trace_bench: error: {}\n", e.what());
        return 1;
    }
}
