// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/measure.h>

#include <cstdint>
#include <string>

namespace asperity::bench {

/// A surface of surfaces.h, made with all threads.
Heightfield make_bench_surface(const std::string& name, int size);

/// One layer of perfect mirrors: `rays` from one direction, sorted into the equal-area cells that
/// trace_bench uses.
Experiment bench_experiment(double theta_deg, std::uint64_t rays);

/// A call of measure() and what it took.
struct TimedRun {
    Measurement measurement;
    double cpu_seconds = 0;  ///< of the calling thread: all of it when threads = 1
    double wall_seconds = 0;
};
TimedRun timed_measure(const Heightfield& surface, const Experiment& experiment, int threads);

/// CPU seconds of what measure() does once a run, beside tracing: that of a run of a few rays, on
/// one thread, the median of three.
double setup_cpu_seconds(const Heightfield& surface, Experiment experiment);

/// A power of two of rays that one thread traces in `seconds`, at least; 2^28 at most.
std::uint64_t rays_for_seconds(const Heightfield& surface, Experiment experiment, double seconds);

}  // namespace asperity::bench
