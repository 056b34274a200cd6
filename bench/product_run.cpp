// SPDX-License-Identifier: Apache-2.0
#include "product_run.h"

#include "averages.h"
#include "clocks.h"
#include "surfaces.h"
#include "tally.h"
#include "workload.h"

#include <asperity/surface/make_surface.h>

#include <algorithm>

namespace asperity::bench {

Heightfield make_bench_surface(const std::string& name, int size) {
    Run run;
    return make_surface(surface_settings(name, size), run);
}

Experiment bench_experiment(double theta_deg, std::uint64_t rays) {
    Experiment experiment;
    experiment.illumination.theta_deg = {theta_deg};
    experiment.illumination.phi_deg = {kPhiDeg};
    experiment.detector.kind = DetectorKind::EqualArea;
    experiment.detector.resolution = DirectionCells::kColumns;
    experiment.run.rays = rays;
    return experiment;
}

TimedRun timed_measure(const Heightfield& surface, const Experiment& experiment, int threads) {
    TimedRun timed;
    Run run(threads);
    const double cpu = cpu_seconds(), wall = wall_seconds();
    timed.measurement = measure(surface, experiment, run);
    timed.cpu_seconds = cpu_seconds() - cpu;
    timed.wall_seconds = wall_seconds() - wall;
    return timed;
}

double setup_cpu_seconds(const Heightfield& surface, Experiment experiment) {
    experiment.run.rays = static_cast<std::uint64_t>(experiment.run.batches);
    std::vector<double> seconds;
    for (int repetition = 0; repetition < 3; ++repetition) {
        seconds.push_back(timed_measure(surface, experiment, 1).cpu_seconds);
    }
    return median(seconds);
}

std::uint64_t rays_for_seconds(const Heightfield& surface, Experiment experiment, double seconds) {
    const double setup = setup_cpu_seconds(surface, experiment);
    std::uint64_t rays = 1 << 16;
    for (; rays < std::uint64_t{1} << 28; rays *= 2) {
        experiment.run.rays = rays;
        const double tracing = timed_measure(surface, experiment, 1).cpu_seconds - setup;
        // Half of it is near enough: the next power of two
        if (tracing > seconds / 2) break;
    }
    return 2 * rays;
}

}  // namespace asperity::bench
