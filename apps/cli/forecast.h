// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>
#include <asperity/gonio/experiment.h>
#include <asperity/surface/heightfield.h>

#include <string>

namespace asperity::cli {

/// A measurement tried on a few rays of up to three of its directions.
struct Forecast {
    double seconds = 0;    ///< of the whole, on the threads of the run; with --until at the least
    double bounces = 0;    ///< mean facets a ray meets
    double truncated = 0;  ///< share of the light that still travels after --bounces reflections
    bool at_least = false;

    /// What a run of more than a minute should be told first: how long it takes and what it spends
    /// that on, one line; empty for a shorter one.
    std::string warning(const Experiment& experiment, const Heightfield& surface) const;
};

/// Costs a thousandth of the time that a run of a minute takes, or a second; nothing where so few
/// rays are asked for that no minute can pass.
/// Stops when `run` is to stop; its progress is not told there.
Forecast forecast(const Heightfield& surface, const Experiment& experiment, const Run& run);

}  // namespace asperity::cli
