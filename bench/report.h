// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "workload.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace asperity::bench {

/// One rival on one workload.
struct Measured {
    std::string rival;
    Tally tally;
    double seconds = 0;  ///< of CPU, median of the repetitions
    std::size_t memory_bytes = 0;
    double build_seconds = 0;

    double paths_per_second() const { return static_cast<double>(tally.paths()) / seconds; }
    double segments_per_second() const { return static_cast<double>(tally.segments()) / seconds; }
};

/// All rivals on one workload; the first one is Asperity.
struct Row {
    std::string surface;
    int size = 0;  ///< samples on a side
    double theta_deg = 0;
    std::vector<Measured> measured;

    const Measured& own() const { return measured.front(); }
    /// The fastest of the others.
    const Measured& best() const;
    double ratio() const { return own().paths_per_second() / best().paths_per_second(); }
    /// Largest distance of another rival's histogram from ours, in units of the distance that runs
    /// with independent launch points would have; far below 1 where all follow the same paths.
    double disagreement() const;
};

/// A table for the eye, with a legend.
std::string table(const std::vector<Row>& rows);

/// All figures: a list with one object per row.
nlohmann::ordered_json json(const std::vector<Row>& rows);

}  // namespace asperity::bench
